#!/usr/bin/env python3
"""Opens pages of `hexwright view` in a headless Chromium: what is shown equals what numpy finds in the mesh, names, keys, links, pictures, no network.

Usage: view_page_test.py BINARY SOURCE_DIR [unittest arguments]; with HEXWRIGHT_SCREENS=FOLDER the screenshots are written there (to be looked at, and
to replace those in screens/), with HEXWRIGHT_LARGE=1 a mesh of a million hexes is opened too. Exit code 77 (skipped) without Playwright, numpy or
Chromium; HEXWRIGHT_CHROMIUM names another browser.
"""
import base64
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

try:
    import numpy as np
    from playwright.sync_api import Error as PlaywrightError, sync_playwright
except ImportError:
    print("skipped: python3 -m pip install playwright numpy")
    sys.exit(77)
from sample_meshes import HexMesh, feature_edges, make_block, make_step, step_patches, write_medit, write_vtk

CHROMIUM = os.environ.get("HEXWRIGHT_CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")
BINARY, SOURCE = Path(sys.argv[1]), Path(sys.argv[2])
SCREENS = Path(__file__).parent / "screens"
WRITE_SCREENS = os.environ.get("HEXWRIGHT_SCREENS")
# The same pixels on any machine: drawn in software.
FLAGS = ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--force-color-profile=srgb", "--hide-scrollbars", "--enable-precise-memory-info"]


class Viewer:
    """A page, with what it said and asked for."""

    def __init__(self, browser, file, hash="", scheme="light"):
        context = browser.new_context(viewport={"width": 1280, "height": 800}, color_scheme=scheme, reduced_motion="reduce", offline=True, accept_downloads=True)
        self.page = context.new_page()
        self.problems, self.requests = [], []
        self.page.on("pageerror", lambda error: self.problems.append(str(error)))
        self.page.on("console", lambda message: self.problems.append(message.text))
        self.page.on("request", lambda request: self.requests.append(request.url[:80]))
        self.page.goto(file.resolve().as_uri() + hash)
        self.page.wait_for_selector("body[data-ready]", timeout=120000)
        self.ready = int(self.page.evaluate("document.body.dataset.ready"))

    def settle(self):
        """After the frames that a change asks for."""
        self.page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 0))))")

    def press(self, *keys):
        for key in keys:
            self.page.keyboard.press(key)
        self.settle()

    def slide(self, id, value):
        self.page.evaluate("([id, value]) => { const s = document.getElementById(id); s.value = value; s.dispatchEvent(new Event('input')); }", [id, value])
        self.settle()

    def check(self, selector, is_checked):
        self.page.set_checked(selector, is_checked)
        self.settle()

    def hexes(self):
        return int(self.page.evaluate("document.getElementById('status').dataset.hexes"))

    def faces(self):
        return int(self.page.evaluate("document.getElementById('status').dataset.faces"))

    def text(self, selector):
        return self.page.locator(selector).inner_text()

    def pressed(self, selector):
        return self.page.locator(selector).get_attribute("aria-pressed") == "true"

    def screenshot(self):
        self.settle()
        return self.page.locator("#stage").screenshot()


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.viewers = []

    def open(self, file, **options):
        viewer = Viewer(self.browser, file, **options)
        self.viewers.append(viewer)
        return viewer

    def tearDown(self):
        """Whatever was done: not a word on the console, and nothing asked of the network."""
        while self.viewers:
            viewer = self.viewers.pop()
            self.assertEqual(viewer.problems, [])
            self.assertEqual([u for u in viewer.requests if not u.startswith(("file:", "blob:", "data:"))], [])
            viewer.page.context.close()

    def assert_shows(self, viewer, mesh, kept):
        self.assertEqual(viewer.hexes(), int(kept.sum()))
        self.assertEqual(viewer.faces(), mesh.num_faces(kept))

    def difference(self, browser, *pictures):
        """Share of pixels that differ visibly: letters may, a face may not."""
        page = browser.new_page()
        share = page.evaluate("""async sources => {
            const [a, b] = await Promise.all(sources.map(async source => {
                const image = new Image(); image.src = 'data:image/png;base64,' + source; await image.decode();
                const canvas = Object.assign(document.createElement('canvas'), {width: image.width, height: image.height}), context = canvas.getContext('2d');
                context.drawImage(image, 0, 0); return context.getImageData(0, 0, image.width, image.height); }));
            if (a.width !== b.width || a.height !== b.height) return 1;
            let count = 0;
            for (let i = 0; i < a.data.length; i += 4) if (Math.max(...[0, 1, 2].map(k => Math.abs(a.data[i + k] - b.data[i + k]))) > 40) ++count;
            return count / (a.width * a.height); }""", [base64.b64encode(p).decode() for p in pictures])
        page.close()
        return share


def run(*arguments):
    subprocess.run([str(BINARY), *map(str, arguments), "--quiet"], check=True, timeout=300)


class Step(PageTest):
    """A small mesh made here, with two regions, eight patches, curves and corners."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = make_step()
        cls.quads, cls.patches = step_patches(cls.mesh)
        cls.num_curves, cls.num_corners = write_medit(cls.folder / "step.mesh", cls.mesh, cls.quads, cls.patches)
        cls.file = cls.folder / "step.html"
        run("view", cls.folder / "step.mesh", "-o", cls.file, "--no-open")

    def test_the_policy_forbids_everything_but_its_own_script_and_style(self):
        viewer = self.open(self.file)
        policy = viewer.page.locator("meta[http-equiv]").get_attribute("content")
        self.assertRegex(policy, r"^default-src 'none'; script-src 'sha256-[^']+'; style-src 'sha256-[^']+'")
        self.assertNotIn("unsafe", policy)
        text = self.file.read_text()
        self.assertTrue("three.js authors" in text and "Permission is hereby granted" in text, "the licences are in the page")
        self.assertEqual(re.findall(r'(?:src|href)="(?:https?:)?//', text), [])

    def test_all_is_shown_at_first(self):
        viewer = self.open(self.file)
        self.assert_shows(viewer, self.mesh, np.ones(len(self.mesh.hexes), bool))
        self.assertEqual(viewer.text("#title"), "step.mesh")
        self.assertIn(f"{len(self.mesh.hexes):,} hexes", viewer.text("#figures"))

    def test_cuts_keep_the_hexes_that_numpy_keeps(self):
        viewer = self.open(self.file)
        for axis in "xyz":
            viewer.press(axis)
            for near in (0.137, 0.46, 0.811):
                offset = self.mesh.clear_place("xyz".index(axis), near)
                viewer.slide("offset", offset)
                below = self.mesh.below("xyz".index(axis), offset)
                self.assert_shows(viewer, self.mesh, ~below if viewer.pressed("#flip") else below)
                viewer.press("f")
                self.assert_shows(viewer, self.mesh, ~below if viewer.pressed("#flip") else below)
        viewer.press("o")
        self.assertEqual(viewer.hexes(), len(self.mesh.hexes))

    def test_peeling_takes_layers_off(self):
        viewer, depth = self.open(self.file), self.mesh.depths()
        for layers in range(1, depth.max() + 1):
            viewer.press("p")
            self.assert_shows(viewer, self.mesh, depth >= layers)

    def test_the_filter_keeps_a_range_of_quality(self):
        viewer, quality = self.open(self.file), self.mesh.scaled_jacobians()
        for low, high in ((0, 40), (30, 50), (22, 43), (0, 1)):
            viewer.slide("low", low)
            viewer.slide("high", high)
            kept = ((quality >= low / 50) | (low == 0)) & ((quality < high / 50) | (high == 50))
            self.assert_shows(viewer, self.mesh, kept)

    def test_keys_and_sliders_keep_a_step_between_the_limits(self):
        viewer, quality = self.open(self.file), self.mesh.scaled_jacobians()
        viewer.slide("high", 1)
        viewer.slide("low", 40)
        for high in (41, 40, 39):
            kept = (quality >= (high - 1) / 50) & (quality < high / 50)
            self.assertGreater(kept.sum(), 0)
            self.assert_shows(viewer, self.mesh, kept)
            viewer.press("[")

    def test_a_drag_over_the_histogram_keeps_its_bins(self):
        viewer, quality = self.open(self.file), self.mesh.scaled_jacobians()
        viewer.page.locator("#histogram").scroll_into_view_if_needed()
        box = viewer.page.locator("#histogram").bounding_box()
        places = [(box["x"] + (bin + 0.5) / 51 * box["width"], box["y"] + 20) for bin in (46, 38)]  # bin i: from (i - 1) / 50 to i / 50
        viewer.page.mouse.move(*places[0])
        viewer.page.mouse.down()
        viewer.page.mouse.move(*places[1], steps=3)
        viewer.page.mouse.up()
        viewer.settle()
        kept = (quality >= 37 / 50) & (quality < 46 / 50)
        self.assertTrue(0 < kept.sum() < len(quality))
        self.assert_shows(viewer, self.mesh, kept)
        viewer.page.mouse.dblclick(*places[0])
        viewer.settle()
        self.assertEqual(viewer.hexes(), len(quality))

    def test_cut_peel_filter_and_regions_work_together(self):
        viewer = self.open(self.file)
        viewer.press("y", "p")
        offset = self.mesh.clear_place(1, 0.46)
        viewer.slide("offset", offset)
        viewer.slide("high", 44)
        viewer.check("#regions li:nth-child(2) input", False)
        below = self.mesh.below(1, offset)
        kept = (~below if viewer.pressed("#flip") else below) & (self.mesh.depths() >= 1) & (self.mesh.scaled_jacobians() < 0.88) & (self.mesh.regions == 1)
        self.assertGreater(kept.sum(), 20)
        self.assert_shows(viewer, self.mesh, kept)

    def test_regions_and_patches_are_listed_with_counts_and_measures(self):
        viewer = self.open(self.file)
        regions = viewer.page.locator("#regions li").all_inner_texts()
        self.assertEqual(len(regions), 2)
        for tag, text in zip((1, 2), regions):
            self.assertIn(f"{(self.mesh.regions == tag).sum():,} hexes", text)
        patches = viewer.page.locator("#patches li").all_inner_texts()
        self.assertEqual(len(patches), 8)
        for i, text in enumerate(patches):
            quads = self.patches == i
            self.assertRegex(text, rf"PATCH_{i}\s+{quads.sum()}, {self.mesh.area(self.quads[quads]).sum():.5g}$")
        self.assertIn(str(self.num_curves), viewer.text("#curves-label"))
        self.assertIn(str(self.num_corners), viewer.text("#corners-label"))

    def test_curves_are_listed_hidden_and_marked_by_name(self):
        viewer = self.open(self.file)
        self.assertEqual(viewer.page.locator("#curve-list li").count(), self.num_curves)
        edges = feature_edges(self.quads, self.patches)
        for curve, text in enumerate(viewer.page.locator("#curve-list li small").all_inner_texts(), 1):
            own = [(a, b) for a, b, ref in edges if ref == curve]
            self.assertEqual(text, f"{len(own)}, {sum(np.linalg.norm(self.mesh.points[a] - self.mesh.points[b]) for a, b in own):.5g}")
        before = viewer.screenshot()
        for _ in range(2):
            viewer.page.click("#curve-list li:nth-child(1) button")
            seen, before = before, viewer.screenshot()
            self.assertNotEqual(seen, before)
        viewer.page.click("#curve-list li:nth-child(1) button")
        viewer.check("#curve-list li:nth-child(2) input", False)
        viewer.page.click("#link")
        address = viewer.page.input_value("#share textarea")
        again = self.open(self.file, hash="#" + address.split("#", 1)[1])
        self.assertEqual(again.page.locator("#curve-list li.chosen").count(), 1)
        self.assertFalse(again.page.locator("#curve-list li:nth-child(2) input").is_checked())

    def test_hidden_patches_are_not_drawn(self):
        viewer = self.open(self.file)
        viewer.check("#patches li:nth-child(8) input", False)
        self.assertEqual(viewer.faces(), len(self.quads) - int((self.patches == 7).sum()))
        self.assertEqual(viewer.hexes(), len(self.mesh.hexes))
        viewer.page.fill("#find", "PATCH_3")
        viewer.page.click("#no-patches")
        viewer.settle()
        self.assertEqual(viewer.faces(), len(self.quads) - int(np.isin(self.patches, (3, 7)).sum()))
        viewer.page.fill("#find", "")
        viewer.page.click("#all-patches")
        viewer.settle()
        self.assertEqual(viewer.faces(), len(self.quads))

    def test_a_click_on_a_patch_names_it(self):
        for key, patch, place in (("1", 0, (0.5, 0.5)), ("2", 2, (0.5, 0.75)), ("Alt+1", 1, (0.5, 0.75)), ("Alt+1", 6, (0.5, 0.3))):
            viewer = self.open(self.file)
            viewer.press(key)
            box = viewer.page.locator("#view").bounding_box()
            viewer.page.mouse.click(box["x"] + place[0] * box["width"], box["y"] + place[1] * box["height"])
            viewer.settle()
            quads = self.patches == patch
            text = viewer.text("#picked")
            self.assertIn(f"PATCH_{patch}\n", text)
            self.assertIn(f"{quads.sum()} quads, area {self.mesh.area(self.quads[quads]).sum():.5g}", text)
            self.assertEqual(viewer.page.locator("#patches li.chosen").count(), 1)

    def test_the_worst_hexes_are_told_with_their_corners(self):
        viewer, quality = self.open(self.file), self.mesh.scaled_jacobians()
        for hex in np.argsort(quality, kind="stable")[:3]:
            viewer.press("w")
            text = viewer.text("#picked")
            self.assertIn(f"hex {hex:,}", text)
            self.assertIn(f"{quality[hex]:.6g}"[:6], text)
            for vert in self.mesh.hexes[hex]:
                self.assertIn(f"vertex {vert}\t" + "\t".join(f"{x:.5g}" for x in self.mesh.points[vert]), text)
        viewer.press("W")
        self.assertIn(f"hex {np.argsort(quality, kind='stable')[1]:,}", viewer.text("#picked"))

    def test_irregular_edges_are_counted(self):
        viewer = self.open(self.file)
        viewer.press("i", "h")
        # A block of cubes has none inside; its convex edges have one hex about them, the concave one three.
        text = viewer.text("#valences")
        self.assertRegex(text, rf"boundary, 1 about it\s+{self.count_boundary_edges(1)}")
        self.assertRegex(text, r"boundary, 3 about it\s+10\b")

    def count_boundary_edges(self, valence):
        edges = np.sort(self.mesh.hexes[:, [0, 1, 1, 2, 3, 2, 0, 3, 4, 5, 5, 6, 7, 6, 4, 7, 0, 4, 1, 5, 2, 6, 3, 7]].reshape(-1, 2), 1)
        return int((np.unique(edges, axis=0, return_counts=True)[1] == valence).sum())

    def test_a_link_restores_the_view(self):
        viewer = self.open(self.file)
        viewer.press("2", "x", "p", "h", "h")
        viewer.slide("offset", 0.61)
        viewer.page.select_option("#color", "region")
        viewer.check("#patches li:nth-child(1) input", False)
        viewer.page.locator("#view").focus()
        viewer.press("ArrowLeft", "ArrowDown", "+")
        viewer.page.click("#link")
        address = viewer.page.input_value("#share textarea")
        viewer.page.click("#share button")
        viewer.page.locator("#view").blur()
        again = self.open(self.file, hash="#" + address.split("#", 1)[1])
        self.assertEqual((again.hexes(), again.faces()), (viewer.hexes(), viewer.faces()))
        self.assertEqual(again.screenshot(), viewer.screenshot())

    def test_addresses_that_make_no_sense_are_passed_over(self):
        for hash in ("#cut=q,1,2", "#cut=toString,1,0,0,0.5,0", "#eye=1,2", "#hex=99999999,3&patch=-4&worst=1e9&color=%00&quality=x,y&regions=,,&opacity=nan", "#quality=40,10&peel=200", "#%%%"):
            self.assertEqual(self.open(self.file, hash=hash).hexes(), len(self.mesh.hexes), hash)

    def test_the_picture_is_a_png_with_a_legend(self):
        viewer = self.open(self.file)
        for color, rows in (("quality", 2), ("patch", 2), ("plain", 1)):
            viewer.page.select_option("#color", color)
            viewer.page.locator("#view").focus()
            with viewer.page.expect_download() as download:
                viewer.press("s")
            picture = Path(download.value.path()).read_bytes()
            self.assertTrue(picture.startswith(b"\x89PNG\r\n\x1a\n"))
            self.assertEqual((int.from_bytes(picture[16:20], "big"), int.from_bytes(picture[20:24], "big")), (960, 800 + 24 * rows), color)
            self.assertEqual(download.value.suggested_filename, "step.mesh.png")

    def test_the_handle_drags_the_plane(self):
        viewer = self.open(self.file)
        viewer.press("x")
        before, box = viewer.hexes(), viewer.page.locator("#handle").bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        viewer.page.mouse.move(x, y)
        viewer.page.mouse.down()
        viewer.page.mouse.move(x + 90, y, steps=4)
        viewer.page.mouse.up()
        viewer.settle()
        self.assertNotEqual(viewer.hexes(), before)
        moved = viewer.page.locator("#handle").bounding_box()
        self.assertAlmostEqual(moved["x"] - box["x"], 90, delta=12)

    def test_the_mouse_turns_moves_and_zooms(self):
        viewer = self.open(self.file)
        seen = {viewer.screenshot()}
        for action in ("turn", "move", "zoom"):
            viewer.page.mouse.move(400, 400)
            if action == "zoom":
                viewer.page.mouse.wheel(0, -200)
            else:
                viewer.page.mouse.down(button="left" if action == "turn" else "right")
                viewer.page.mouse.move(460, 430, steps=3)
                viewer.page.mouse.up(button="left" if action == "turn" else "right")
            seen.add(viewer.screenshot())
        self.assertEqual(len(seen), 4)

    def test_all_can_be_done_by_keys_alone(self):
        viewer = self.open(self.file)
        reached = set()
        for _ in range(70):
            viewer.page.keyboard.press("Tab")
            reached.add(viewer.page.evaluate("document.activeElement.id || document.activeElement.dataset.look || document.activeElement.dataset.cut || document.activeElement.textContent"))
        needed = {"view", "picture", "link", "reset", "theme", "help", "iso", "+x", "-z", "x", "y", "z", "peel", "low", "high", "worst", "next", "previous", "color", "edges",
                  "pale", "curves", "corners", "irregular", "faces", "find", "PATCH_0", "PATCH_7", "REGION_1"}
        self.assertEqual(needed - reached, set())
        viewer.page.locator("#view").focus()
        first = viewer.screenshot()
        viewer.press("ArrowRight", "ArrowUp")
        self.assertNotEqual(viewer.screenshot(), first)
        viewer.page.locator("[data-cut=z]").focus()
        viewer.press("Enter", ".")
        self.assertLess(viewer.hexes(), len(self.mesh.hexes))
        at = float(viewer.page.input_value("#offset"))
        viewer.page.locator("#handle").focus()
        viewer.press("ArrowUp")
        self.assertAlmostEqual(float(viewer.page.input_value("#offset")), at + 0.02, places=6)
        viewer.press("r")
        viewer.page.locator("#peel").focus()
        viewer.press("ArrowRight")
        self.assertEqual(viewer.hexes(), int((self.mesh.depths() >= 1).sum()))
        viewer.page.locator("#patches li:nth-child(3) input").focus()
        viewer.press("Space")
        self.assertFalse(viewer.page.locator("#patches li:nth-child(3) input").is_checked())
        for key, id in (("h", "faces"), ("e", "edges"), ("i", "irregular")):
            before = viewer.page.locator(f"#{id}").is_checked()
            viewer.press(key)
            self.assertEqual(viewer.page.locator(f"#{id}").is_checked(), not before, id)
        viewer.press("?")
        self.assertTrue(viewer.page.locator("#keys").is_visible())
        viewer.press("Escape")
        self.assertFalse(viewer.page.locator("#keys").is_visible())

    def test_every_choice_of_colours_looks_different(self):
        viewer, seen = self.open(self.file), set()
        viewer.press("x")
        options = viewer.page.eval_on_selector_all("#color option", "options => options.map(o => o.value)")
        self.assertEqual(options, ["quality", "patch", "region", "layer", "plain"])
        for option in options:
            viewer.page.select_option("#color", option)
            seen.add(viewer.screenshot())
        self.assertEqual(len(seen), len(options))

    def test_light_and_dark_follow_the_system_and_the_button(self):
        background = "getComputedStyle(document.body).backgroundColor"
        light, dark = (self.open(self.file, scheme=scheme) for scheme in ("light", "dark"))
        colors = [viewer.page.evaluate(background) for viewer in (light, dark)]
        self.assertNotEqual(*colors)
        for viewer in (light, dark):
            viewer.press("t")
        self.assertEqual([viewer.page.evaluate(background) for viewer in (dark, light)], colors)

    def test_it_fits_the_screens_of_laptops_and_phones(self):
        viewer = self.open(self.file)
        for width, height in ((1024, 600), (800, 600), (420, 800)):
            viewer.page.set_viewport_size({"width": width, "height": height})
            viewer.settle()
            self.assertTrue(viewer.page.evaluate("document.documentElement.scrollWidth <= innerWidth && document.documentElement.scrollHeight <= innerHeight"))
            self.assertTrue(viewer.page.evaluate("document.getElementById('panel').scrollWidth <= document.getElementById('panel').clientWidth"), width)
            stage = viewer.page.locator("#stage").bounding_box()
            self.assertGreaterEqual(min(stage["width"], stage["height"]), 400)

    def test_two_openings_give_the_same_pixels(self):
        self.assertEqual(self.open(self.file).screenshot(), self.open(self.file).screenshot())

    def test_screenshots_look_like_those_that_were_looked_at(self):
        views = {"outside": [], "cut": ["y"], "patches": ["c"], "worst": ["w"], "peeled_dark": ["t", "p", "c", "c", "c"], "irregular": ["i", "h"]}
        for name, keys in views.items():
            viewer = self.open(self.file)
            viewer.press(*keys)
            picture = viewer.screenshot()
            if WRITE_SCREENS:
                (Path(WRITE_SCREENS) / f"{name}.png").write_bytes(picture)
            else:
                self.assertLess(self.difference(viewer.page.context.browser, picture, (SCREENS / f"{name}.png").read_bytes()), 0.01, name)


class Curved(PageTest):
    """One hex of second order, whose edges along z bulge."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        corners = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        ends = [(k, (k + 1) % 4) for k in range(4)] + [(4 + k, 4 + (k + 1) % 4) for k in range(4)] + [(k, k + 4) for k in range(4)]
        middles = [[(p + q) / 2 for p, q in zip(corners[a], corners[b])] for a, b in ends]
        for (x, y, _), middle in zip(corners[:4], middles[8:]):
            middle[0] += 0.4 if x else -0.4
            middle[1] += 0.4 if y else -0.4
        nodes = "".join(f"{k}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate(corners + middles, 1))
        (cls.folder / "barrel.inp").write_text("*NODE\n" + nodes + "*ELEMENT, TYPE=C3D20\n1, " + ", ".join(map(str, range(1, 16))) +
                                               ",\n" + ", ".join(map(str, range(16, 21))) + "\n")
        run("view", cls.folder / "barrel.inp", "-o", cls.folder / "barrel.html", "--no-open")

    def test_edges_and_faces_are_drawn_curved(self):
        viewer = self.open(self.folder / "barrel.html")
        self.assertEqual((viewer.hexes(), viewer.faces()), (1, 6))
        if WRITE_SCREENS:
            (Path(WRITE_SCREENS) / "curved.png").write_bytes(viewer.screenshot())
        else:
            self.assertLess(self.difference(viewer.page.context.browser, viewer.screenshot(), (SCREENS / "curved.png").read_bytes()), 0.01)

    def leftmost(self, viewer):
        """The first place of the middle row, in pixels of the page, where something is drawn."""
        box = viewer.page.locator("#stage").bounding_box()
        x = viewer.page.evaluate("""async source => {
            const image = new Image(); image.src = 'data:image/png;base64,' + source; await image.decode();
            const canvas = Object.assign(document.createElement('canvas'), {width: image.width, height: image.height}), context = canvas.getContext('2d');
            context.drawImage(image, 0, 0);
            const {data} = context.getImageData(0, image.height >> 1, image.width, 1), from = 4;
            let x = from;
            while (x < image.width && [0, 1, 2].every(k => Math.abs(data[4 * x + k] - data[4 * from + k]) < 40)) ++x;
            return x / image.width; }""", base64.b64encode(viewer.screenshot()).decode())
        return box["x"] + x * box["width"], box["y"] + box["height"] / 2

    def test_a_click_where_a_face_bulges_meets_it(self):
        """Far outside of the straight quads between the corners; and beside the bulge it meets nothing."""
        viewer = self.open(self.folder / "barrel.html")
        viewer.press("1")
        x, y = self.leftmost(viewer)
        for step, is_met in ((6, True), (-6, False)):
            viewer.page.mouse.click(x + step, y)
            viewer.settle()
            self.assertEqual(viewer.page.locator("#picked").is_visible(), is_met, viewer.text("#picked"))


class Part(PageTest):
    """A part meshed by the program, with verdict, input surface and levels."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        surface = SOURCE / "data/models/cube_minus_sphere.obj"
        run("mesh", surface, "-o", cls.folder / "part.mesh", "--max-level", "4", "--rounds", "1", "--tolerance", "2%", "--view", cls.folder / "part.html")
        run("check", cls.folder / "part.mesh", surface, "--view", cls.folder / "checked.html")
        cls.mesh = read_medit(cls.folder / "part.mesh")

    def test_counts_are_those_of_the_written_mesh(self):
        viewer, quality = self.open(self.folder / "part.html"), self.mesh.scaled_jacobians()
        self.assertEqual(viewer.hexes(), len(self.mesh.hexes))
        viewer.press("z")
        offset = self.mesh.clear_place(2, 0.43)
        viewer.slide("offset", offset)
        below = self.mesh.below(2, offset)
        self.assert_shows(viewer, self.mesh, ~below if viewer.pressed("#flip") else below)
        viewer.press("o", "p")
        self.assert_shows(viewer, self.mesh, self.mesh.depths() >= 1)
        viewer.press("P")
        viewer.slide("high", 40)
        self.assert_shows(viewer, self.mesh, quality < 0.8)

    def test_it_tells_the_verdict_and_has_the_surface_and_levels(self):
        viewer = self.open(self.folder / "part.html")
        self.assertIn("valid", viewer.text("#verdict"))
        self.assertIn("scaled Jacobian: least", viewer.text("#report"))
        options = viewer.page.eval_on_selector_all("#color option", "options => options.map(o => o.textContent)")
        self.assertEqual(options, ["scaled Jacobian", "patch", "layer from the boundary", "distance to the surface", "level", "one colour"])
        before = viewer.screenshot()
        viewer.check("#surface", True)
        self.assertNotEqual(viewer.screenshot(), before)
        viewer.page.select_option("#color", "distance")
        viewer.settle()
        self.assertIn("% of the diagonal", viewer.text("#legend"))

    def test_groups_of_the_surface_are_named(self):
        """A cube whose lower side is the group inlet, its upper one a name with letters of other alphabets, the rest wall."""
        corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        groups = {"inlet": [(1, 3, 4, 2)], "ausla\u00df <\u4e2d>": [(5, 6, 8, 7)], "wall": [(1, 5, 7, 3), (2, 4, 8, 6), (1, 2, 6, 5), (3, 7, 8, 4)]}
        lines = ["v %d %d %d" % c for c in corners]
        for name, quads in groups.items():
            lines += [f"g {name}", *("f " + " ".join(map(str, quad)) for quad in quads)]
        (self.folder / "named.obj").write_text("\n".join(lines) + "\n", encoding="utf-8")
        run("mesh", self.folder / "named.obj", "-o", self.folder / "named.vtu", "--max-level", "3", "--rounds", "0", "--tolerance", "5%", "--view", self.folder / "named.html")
        viewer = self.open(self.folder / "named.html")
        names = viewer.page.locator("#patches li button").all_inner_texts()
        self.assertEqual(sorted(names)[:2], ["ausla\u00df <\u4e2d>", "inlet"])
        self.assertTrue(all(name.startswith("wall") for name in sorted(names)[2:]), names)
        viewer.press("Alt+3")  # from below
        viewer.page.mouse.click(480, 400)
        viewer.settle()
        self.assertIn("patch\ninlet\n", viewer.text("#picked"))

    def test_check_writes_one_too(self):
        viewer = self.open(self.folder / "checked.html")
        self.assertIn("valid", viewer.text("#verdict"))
        self.assertEqual(viewer.hexes(), len(self.mesh.hexes))


def read_medit(path):
    words = iter(path.read_text().split())
    arrays = {}
    for word in words:
        width = {"Vertices": 4, "Hexahedra": 9}.get(word)
        if width:
            count = int(next(words))
            arrays[word] = np.array([next(words) for _ in range(count * width)], float).reshape(count, width)
    return HexMesh(arrays["Vertices"][:, :3], arrays["Hexahedra"][:, :8].astype(int) - 1)


class Large(PageTest):
    def test_a_hundred_thousand_hexes(self):
        self.open_block(46)

    @unittest.skipUnless(os.environ.get("HEXWRIGHT_LARGE"), "a million hexes: with HEXWRIGHT_LARGE=1")
    def test_a_million_hexes(self):
        self.open_block(100)

    @unittest.skipUnless(os.environ.get("HEXWRIGHT_LARGE"), "two million hexes: with HEXWRIGHT_LARGE=1")
    def test_two_million_hexes_and_more_are_shown_in_part(self):
        mesh, viewer = self.write_and_open(130)
        self.assertRegex(viewer.text("#sample"), r"shows [\d,]+ of 2,197,000 hexes.*the worst 10,000")
        viewer.press("x")
        side = mesh.centers()[:, 0] > 130 * 0.5003
        self.assertEqual(viewer.faces(), mesh.num_faces(side if viewer.pressed("#flip") else ~side))
        self.tell_seconds_of_a_cut(viewer)

    def write_and_open(self, n):
        mesh, file = make_block((n, n, n), 0.25), self.folder / f"block{n}.html"
        write_vtk(self.folder / "block.vtk", mesh)
        start = time.monotonic()
        run("view", self.folder / "block.vtk", "-o", file, "--no-open")
        written = time.monotonic()
        viewer = self.open(file)
        heap = viewer.page.evaluate("performance.memory.usedJSHeapSize")
        print(f"\n{len(mesh.hexes):,} hexes: page of {file.stat().st_size / 1e6:.1f} MB in {written - start:.1f} s, ready {viewer.ready / 1000:.1f} s after opening, heap {heap / 1e6:.0f} MB")
        return mesh, viewer

    def tell_seconds_of_a_cut(self, viewer):
        """From moving the plane until all of the next frame is drawn; the least and the most of five."""
        times = viewer.page.evaluate("""async () => {
            const slider = document.getElementById('offset'), times = [], gl = document.getElementById('view').getContext('webgl2'), pixel = new Uint8Array(4);
            for (const place of [0.3, 0.4, 0.6, 0.7, 0.5]) {
                const start = performance.now();
                slider.value = place; slider.dispatchEvent(new Event('input'));
                await new Promise(requestAnimationFrame);
                gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);  // waits until it is drawn
                times.push(performance.now() - start);
            }
            return times; }""")
        print(f"a cut in {min(times) / 1000:.2f} to {max(times) / 1000:.2f} s")

    def open_block(self, n):
        mesh, viewer = self.write_and_open(n)
        self.assertEqual(viewer.hexes(), len(mesh.hexes))
        viewer.press("y")
        offset = (n // 3) / n  # between two layers: no centre is near
        viewer.page.evaluate("document.getElementById('offset').step = 'any'")
        viewer.slide("offset", offset)
        below = mesh.below(1, offset)
        self.assert_shows(viewer, mesh, ~below if viewer.pressed("#flip") else below)
        self.tell_seconds_of_a_cut(viewer)

    def test_above_the_limit_skin_slices_and_worst_are_shown_and_it_is_said(self):
        mesh, file = make_block((30, 30, 30), 0.25), self.folder / "part_of_block.html"
        write_vtk(self.folder / "block30.vtk", mesh)
        run("view", self.folder / "block30.vtk", "-o", file, "--no-open", "--whole-up-to", 26999)
        beyond, quality = mesh.neighbors(), mesh.scaled_jacobians()
        skin = (beyond < 0).any(1)
        taken = skin.copy()
        for axis in range(3):
            for share in (0.2503, 0.5003, 0.7503):
                side = mesh.centers()[:, axis] > 30 * share
                taken |= ((side[:, None] != side[beyond]) & (beyond >= 0)).any(1)
        taken[np.argsort(quality, kind="stable")[:10000]] = True
        viewer = self.open(file)
        self.assertEqual(viewer.hexes(), int(taken.sum()))
        self.assertEqual(viewer.faces(), mesh.num_faces(np.ones(27000, bool)), "what the skin encloses is not drawn")
        text = viewer.text("#sample")
        for number in (taken.sum(), 27000, skin.sum(), 10000):
            self.assertIn(f"{number:,}", text)
        viewer.press("x")
        viewer.slide("offset", 0.7)  # goes to the slice nearest by
        self.assertAlmostEqual(float(viewer.page.evaluate("document.getElementById('offset').value")), 0.75, places=3)
        side = mesh.centers()[:, 0] > 30 * 0.7503
        self.assertEqual(viewer.hexes(), int((taken & (side if viewer.pressed("#flip") else ~side)).sum()))
        self.assertEqual(viewer.faces(), mesh.num_faces(side if viewer.pressed("#flip") else ~side), "the faces that the whole mesh would show")
        viewer.press("i")
        self.assertRegex(viewer.text("#valences"), r"^\s*boundary, 1 about it\s+360\s+Of edges whose hexes are all on this page.$")
        viewer.press("i", "o", "p")
        self.assert_shows(viewer, HexMesh(mesh.points, mesh.hexes[taken]), mesh.depths()[taken] >= 1)
        viewer.press("r", "w")
        self.assertIn(f"hex {np.argmin(quality):,}", viewer.text("#picked"))
        viewer.press("x")  # from the plane through the worst hex to the slice nearest by
        offset = float(viewer.page.evaluate("document.getElementById('offset').value"))
        share = min((0.2503, 0.5003, 0.7503), key=lambda share: abs(share - offset))
        side = mesh.centers()[:, 0] > 30 * share
        self.assertEqual(viewer.hexes(), int((taken & (side if viewer.pressed("#flip") else ~side)).sum()))
        again = self.open(file, hash="#eye=-115,24,2,0,0,0&cut=x,1,0,0,0.1,0")
        self.assertEqual(again.hexes(), int((taken & (mesh.centers()[:, 0] < 30 * 0.2503)).sum()), "an address stays at the slices too")


def main():
    if not CHROMIUM:
        print("skipped: no chromium in the path")
        return 77
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        try:
            PageTest.browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        except PlaywrightError as error:
            print(f"skipped: {CHROMIUM} does not start: {error}")
            return 77
        PageTest.folder = Path(folder)
        program = unittest.main(argv=[sys.argv[0], *sys.argv[3:]], exit=False, verbosity=2)
        PageTest.browser.close()
        return 0 if program.result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
