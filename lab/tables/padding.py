"""What selective padding saves against a layer everywhere, over the featured models of a folder (docs/results/padding.md).

The grid of a model is that of its result (`hexwright mesh --save-grid`, with the options after `--`; `--rounds 0` gives the
loop's first). Its hexes are fitted with either padding. A model counts as featured when its surface has feature curves of
which a tenth or more of the length is mapped.
"""
from measures import surfaces, table
from pool import Job

PAGE = "padding.md"
DATA = "models"
SECONDS = 900
WAYS = ("selective", "everywhere")
LEAST_MAPPED = 0.1
POORER = 0.02  # of the scaled Jacobian, from which a least one counts as lower


def jobs(args):
    steps = [["{program}", "mesh", "{input}", "-o", "{out}/mesh.vtu", "--save-grid", "{out}/grid.cells", "--report", "{out}/report.json",
              "--quiet", "--threads", "1", *args.options],
             ["{program}", "dual", "{out}/grid.cells", "-o", "{out}/background.mesh", "--quiet"]]
    for way in WAYS:
        steps += [["{program}", "fit", "{out}/background.mesh", "{input}", "-o", "{out}/fitted.vtu", "--padding", way, "--quiet", "--threads", "1"],
                  ["{program}", "check", "{out}/fitted.vtu", "{input}", "--json"]]
    return [Job(p.stem, steps, p, goes_on=lambda done: len(done) > 1 or is_featured(done[0])) for p in surfaces(args.data)]


def is_featured(step):
    fit = (step.get("report") or {}).get("fit") or {}
    return fit.get("curve_length", 0) > 0 and fit["curve_length_mapped"] >= LEAST_MAPPED * fit["curve_length"]


def figures_of(step):
    verdict = step["report"]
    quality, distance = verdict["quality"], verdict["distance"]
    return {"hexes": verdict["topology"]["hexes"], "min": quality["min_scaled_jacobian"], "avg": quality["avg_scaled_jacobian"],
            "max": 100 * distance["max"], "mean": 100 * distance["mean"], "share": 100 * verdict["features"]["length_share"]}


def saved(pair):
    return 1 - pair["selective"]["hexes"] / pair["everywhere"]["hexes"]


def row(name, pair):
    both = [" / ".join(f"{pair[way][key]:{form}}" for way in WAYS) for key, form in
            (("hexes", ","), ("min", ".2f"), ("avg", ".2f"), ("max", ".2f"), ("mean", ".4f"), ("share", ".1f"))]
    return [name, both[0], f"{100 * saved(pair):.0f}%", *both[1:]]


def summary(pairs):
    total = {way: sum(pair[way]["hexes"] for pair in pairs) for way in WAYS}
    lower = sum(pair["selective"]["min"] < pair["everywhere"]["min"] - POORER for pair in pairs)
    higher = sum(pair["selective"]["min"] > pair["everywhere"]["min"] + POORER for pair in pairs)
    return (f"{len(pairs)} featured models: {total['selective']:,} hexes for {total['everywhere']:,}, "
            f"{100 * (1 - total['selective'] / total['everywhere']):.0f}% saved in all, {100 * sum(map(saved, pairs)) / len(pairs):.0f}% in the mean; "
            f"the least scaled Jacobian is lower by more than {POORER} on {lower}, higher on {higher}.\n")


def page(records, args):
    done = [r for r in records if len(r["steps"]) == 6 and all(s.get("report") for s in (r["steps"][3], r["steps"][5]))]
    pairs = {r["model"]: dict(zip(WAYS, map(figures_of, (r["steps"][3], r["steps"][5])))) for r in done}
    return (f"# Selective padding against a layer everywhere\n\nMade by `{args.command}`: the same background fitted with either padding. "
            "\"Curves met\" is the share of the feature length within 0.1% of the diagonal of edges that the mesh marks as features.\n\n"
            + (summary(list(pairs.values())) if pairs else "No featured model.\n") + "\n"
            + table(["model", "hexes selective / everywhere", "saved", "least scaled Jacobian", "average", "max %", "mean %", "curves met %"],
                    "lrrlllll", [row(*item) for item in pairs.items()]))
