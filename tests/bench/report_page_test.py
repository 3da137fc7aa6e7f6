#!/usr/bin/env python3
"""Opens the report of `hexwright bench` in a headless Chromium: no errors, no network, sorting, filtering, hovering, themes.

Usage: report_page_test.py BINARY SOURCE_DIR [REPORT.html SCREENSHOT_PREFIX]. With a report it tests nothing but takes
pictures of that. Exit code 77 (skipped) without Playwright or Chromium; HEXWRIGHT_CHROMIUM names another browser.
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    from playwright.sync_api import Error as PlaywrightError, sync_playwright
except ImportError:
    print("skipped: python3 -m pip install playwright")
    sys.exit(77)

CHROMIUM = os.environ.get("HEXWRIGHT_CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")
if not CHROMIUM:
    print("skipped: no chromium in the path")
    sys.exit(77)


def make_report(binary, source, folder):
    models = folder / "models"
    models.mkdir()
    for name in ("3holes.obj", "cube_minus_sphere.obj"):
        shutil.copy(source / "data" / "models" / name, models)
    (models / "broken <b>.obj").write_text("v 0 0 0\nf 1 2 99\n")
    subprocess.run([binary, "bench", models, "-o", folder / "out", "--grid-max-level", "4", "--max-level", "4", "--rounds", "0",
                    "--tolerance", "3%", "--jobs", "2", "--picture-width", "160", "--quiet"], check=True, timeout=300)
    return folder / "out" / "report.html"


def open_page(browser, report, scheme):
    page = browser.new_page(viewport={"width": 1440, "height": 1000}, color_scheme=scheme)
    page.problems, page.requests = [], []
    page.on("pageerror", lambda error: page.problems.append(str(error)))
    page.on("console", lambda message: page.problems.append(message.text) if message.type in ("error", "warning") else None)
    page.on("request", lambda request: page.requests.append(request.url[:80]))
    page.goto(report.resolve().as_uri())
    page.wait_for_timeout(300)
    return page


def names(page):
    visible = page.locator("#models tbody:visible td.name")
    return [t.replace("\u200b", "") for t in visible.all_text_contents()]


def check_page(page):
    assert page.problems == [], page.problems
    assert [u for u in page.requests if not u.startswith(("file:", "data:"))] == [], page.requests
    assert names(page) == ["3holes.obj", "broken <b>.obj", "cube_minus_sphere.obj"], names(page)
    assert page.locator("#table1 tbody tr").count() == 5
    assert "scaled Jacobian 0" in page.text_content(".scale") and page.locator(".scale i").first.bounding_box()["width"] > 100
    assert "99" in page.locator("#models .message").first.text_content()
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "the page scrolls sideways"
    widths = page.eval_on_selector_all("#models img", "images => images.map(i => i.naturalWidth)")
    assert len(widths) == 14 and all(w == 160 for w in widths), widths


def check_agreements(page):
    """Figure 11 shows a strip of pictures for every model it names."""
    named = page.evaluate("summary.agree")
    titles = page.locator("#agreeing b").all_text_contents()
    assert len(titles) == len(named) and all(t.startswith(n) for t, n in zip(titles, named)), (titles, named)
    assert page.locator("#agreeing .strip img").count() >= 5 * len(named)


def check_links(page, report):
    """Each model that was meshed has a page to look into its mesh with, which opens from there."""
    links = page.eval_on_selector_all("#models a.look", "links => links.map(a => a.href)")
    assert len(links) == 2, links
    files = [report.parent / "pages" / f"{name}.html" for name in ("3holes.obj", "cube_minus_sphere.obj")]
    assert sorted(links) == [f.resolve().as_uri() for f in files], links
    view = page.context.browser.new_page()
    problems = []
    view.on("console", lambda message: problems.append(message.text))
    view.goto(links[0])
    view.wait_for_selector("body[data-ready]", timeout=60000)
    assert view.text_content("#title") == "3holes.obj" and problems == [], problems
    view.close()


def check_sorting_and_filtering(page):
    head = page.locator("#models th", has_text="input cells")
    head.click()
    down = names(page)
    assert head.get_attribute("aria-sort") == "descending" and down[-1] == "broken <b>.obj", down
    head.click()
    assert names(page) == down[:2][::-1] + down[2:], names(page)
    page.fill("#filter", "holes")
    assert names(page) == ["3holes.obj"] and "1 of 3" in page.text_content("#count")
    page.fill("#filter", "")
    page.select_option("#outcome", "failed")
    assert names(page) == ["broken <b>.obj"]
    page.select_option("#outcome", "")
    page.locator("#models .strip button").first.click()
    assert page.locator("dialog[open] img").is_visible()
    page.locator("dialog[open]").click()


def check_plots(page):
    """Every canvas has ink, and a dot tells its model's name."""
    blank = page.evaluate("""[...document.querySelectorAll('canvas')].filter(c => {
        const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
        return !d.some((v, i) => i % 4 === 3 && v > 0); }).map(c => c.id)""")
    assert blank == [], blank
    place = page.evaluate("""(() => { const chart = Chart.getChart('fig12weak'), dot = chart.getDatasetMeta(0).data[0];
        chart.canvas.scrollIntoView({block: 'center'});
        const box = chart.canvas.getBoundingClientRect(); return [box.x + dot.x, box.y + dot.y]; })()""")
    page.mouse.move(*place)
    page.wait_for_timeout(100)
    text = page.evaluate("Chart.getChart('fig12weak').tooltip.body[0].lines[0]")
    assert "3holes.obj" in text and "%" in text, text


def background(page):
    return page.evaluate("getComputedStyle(document.body).backgroundColor")


def take_pictures(browser, report, prefix):
    for scheme in ("light", "dark"):
        page = open_page(browser, report, scheme)
        page.screenshot(path=f"{prefix}{scheme}.png", full_page=True)
        if scheme == "light":
            for part in ("table1", "shares", "hexes", "fig12strong", "fig12weak", "fig12octree", "fig12sheets", "fig13", "quality", "distance",
                         "agreesection"):
                page.locator(f"#{part}").screenshot(path=f"{prefix}{part}.png")
    print(page.problems)


def main():
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        try:
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader"])
        except PlaywrightError as error:
            print(f"skipped: {CHROMIUM} does not start: {error}")
            sys.exit(77)
        if len(sys.argv) > 3:
            return take_pictures(browser, Path(sys.argv[3]), sys.argv[4])
        report = make_report(sys.argv[1], Path(sys.argv[2]), Path(folder))
        light, dark = (open_page(browser, report, scheme) for scheme in ("light", "dark"))
        assert background(light) != background(dark)
        for page in (light, dark):
            check_page(page)
            check_agreements(page)
            check_links(page, report)
            check_sorting_and_filtering(page)
            check_plots(page)
            assert page.problems == [], page.problems
        browser.close()


if __name__ == "__main__":
    sys.exit(main())
