"""The guard: two sets of records by the limits that a change may not break.

Per model: validity is never lost, and no figure is worse by more than its limit. Over all models that both sets have
meshed: the sums may be worse by a fifth of a model's limit at most (they must not fall; the fifth is the noise of another
compiler). Processor seconds are compared only as a ratio, and only of sets made in one run on one machine.
"""
from dataclasses import dataclass

from measures import figures

SHARE_OF_SUM = 0.2


@dataclass(frozen=True)
class Limit:
    name: str
    key: str
    allowed: float
    is_relative: bool   # to the value before
    more_is_worse: bool


LIMITS = [
    Limit("hexes", "hexes", 0.02, True, True),
    Limit("least scaled Jacobian", "least", 0.05, False, False),
    Limit("average scaled Jacobian", "average", 0.02, False, False),
    Limit("distance", "distance", 0.10, True, True),
    Limit("creases", "creases", 0.01, False, False),
]
# A distance that is as good as none may double; in shares of the diagonal.
LEAST_DISTANCE = 1e-4


def worsening(limit, before, after):
    """How much worse, in the limit's measure; negative when better."""
    change = after - before if limit.more_is_worse else before - after
    return change / max(before, LEAST_DISTANCE if limit.key == "distance" else 1e-12) if limit.is_relative else change


def by_model(records):
    return {(f["model"], f.get("variant", "")): f for f in map(figures, records)}


def compare(before, after):
    """(what is broken, summary), as lines of text."""
    old, new = by_model(before), by_model(after)
    broken = [f"{name(k)}: missing" for k in old if k not in new]
    both = [k for k in old if k in new]
    if not both:
        broken.append("the two sets have no model in common")
    for k in both:
        broken += [f"{name(k)}: {text}" for text in worse(old[k], new[k])]
    summary = []
    for limit in LIMITS:
        pairs = [(old[k][limit.key], new[k][limit.key]) for k in both if has(old[k], limit) and has(new[k], limit)]
        if not pairs:
            continue
        a, b = (sum(column) / len(pairs) for column in zip(*pairs))
        summary.append(f"{limit.name}: {a:.6g} -> {b:.6g} in the mean of {len(pairs)}")
        if worsening(limit, a, b) > SHARE_OF_SUM * limit.allowed:
            broken.append(f"the sum of {summary[-1]}")
    return broken, summary + [f"valid: {sum(old[k]['valid'] for k in both)} -> {sum(new[k]['valid'] for k in both)} of {len(both)}"]


def worse(old, new):
    if old["valid"] and not new["valid"]:
        yield "is not valid any more"
    if old["exit"] == 0 and new["exit"] != 0:
        yield f"ends with {new['exit']} instead of 0"
    for limit in LIMITS:
        if has(old, limit) and not has(new, limit):
            yield f"{limit.name} is missing"
        elif has(old, limit) and worsening(limit, old[limit.key], new[limit.key]) > limit.allowed + 1e-9:
            yield f"{limit.name} went from {old[limit.key]:g} to {new[limit.key]:g}"


def has(record, limit):
    return record.get(limit.key) is not None


def time_ratio(before, after):
    """Processor seconds after over before, of the models both have."""
    old, new = by_model(before), by_model(after)
    both = [k for k in old if k in new]
    return sum(new[k]["cpu_seconds"] for k in both) / max(1e-9, sum(old[k]["cpu_seconds"] for k in both))


def name(key):
    return " ".join(part for part in key if part)
