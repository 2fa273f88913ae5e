"""News from the server does not disturb what a person is doing on the page.

The page is given what the server would tell; no model is made.
"""

from __future__ import annotations

import pytest

sync_api = pytest.importorskip("playwright.sync_api")
expect = sync_api.expect
pytestmark = pytest.mark.browser

TELL = """
async ({ regions, logs, revision }) => {
  const { set } = await import("./js/store.js");
  const nodes = regions.map((region) => ({
    id: `n${region}`, region, label: null, area_m2: 5, position: [region, 0], convexity: 0.1,
  }));
  const edges = nodes.slice(1).map((node, i) => ({
    id: `e${i}`, source: nodes[i].id, target: node.id, doorway: [0, 0], width_m: 1,
  }));
  const rooms = [{ id: "r1", room: 1, label: null, nodes: nodes.map((node) => node.id) }];
  set({
    logs: logs.map((name) => ({
      id: name, name, duration_s: 1, distance_m: 1, size_bytes: 1, model_ids: [],
    })),
    route: {
      page: "model", id: "m", localization: null, growth: false, drift: false, compare: null,
    },
    model: {
      id: "m", name: "home", status: "done", revision, log_ids: ["own"], options: {}, labels: [],
      provenance: {}, area_m2: 10, node_count: nodes.length, room_count: 1, size_bytes: 1,
      created: "2026-01-01T00:00:00Z", nodes, edges, rooms,
    },
  });
}
"""
SHOW_LINE = """
async (name) => {
  const { set } = await import("./js/store.js");
  const measured = { points: [[0, 0], [1, 0]], distance_m: 1 };
  set({ connection: "ready", cutting: name, selected: name, measured });
}
"""
LOOK_BACK = """
async () => {
  const { get, set } = await import("./js/store.js");
  set({ route: { ...get().route, growth: true } });
}
"""
CUTTING = """async () => (await import("./js/store.js")).get().cutting"""


@pytest.fixture
def page(product, open_tab):
    """The dashboard, showing a model of three regions."""
    page = open_tab(product.url)
    page.wait_for_selector(".welcome")
    tell(page, [1, 2, 3], 1)
    return page


def tell(page, regions: list[int], revision: int, logs: tuple[str, ...] = ("own", "a", "b")):
    page.evaluate(TELL, {"regions": regions, "logs": list(logs), "revision": revision})


def test_a_name_is_typed_on_while_regions_come_and_go(page):
    name = page.locator("tr[data-node=n2] input")
    name.focus()
    page.keyboard.type("kit")
    tell(page, [2, 4, 5], 2)
    expect(page.locator("tr[data-node]")).to_have_count(3)
    page.keyboard.type("chen")
    expect(name).to_have_value("kitchen")


def test_a_list_that_acts_at_once_does_nothing_until_a_line_is_chosen(page):
    sent = []
    page.on("request", lambda request: sent.append(request.url))
    page.locator("tr[data-node=n2] .swatch").click()
    merge = page.get_by_label("Merge with…")
    merge.focus()
    page.keyboard.press("ArrowDown")
    expect(merge).to_have_value("")
    assert not [url for url in sent if url.endswith("/edits")]


def test_the_focus_stays_where_it_is_when_the_model_is_told_again(page):
    page.locator("tr[data-node=n2] .swatch").click()
    split = page.get_by_role("button", name="Split…")
    split.focus()
    tell(page, [1, 2, 3, 4], 2)
    expect(page.locator("tr[data-node]")).to_have_count(4)
    expect(split).to_be_focused()


def test_a_line_to_cut_along_does_not_take_the_cursor_out_of_a_name(page):
    expect(page.locator(".dot")).to_have_attribute("data-kind", "bad")  # there is no view of it
    name = page.locator("tr[data-node=n2] input")
    name.focus()
    page.keyboard.type("bath")
    page.evaluate(SHOW_LINE, "n2")
    expect(page.get_by_role("button", name="Split", exact=True)).to_be_visible()
    page.keyboard.type("room")
    expect(name).to_have_value("bathroom")


def test_the_log_to_go_on_with_stays_chosen(page):
    page.get_by_text("About this model").click()
    page.get_by_label("Log", exact=True).last.select_option("b")
    tell(page, [1, 2, 3, 4], 2, logs=("own", "a", "b", "c"))
    expect(page.get_by_label("Log", exact=True).last.locator("option")).to_have_count(3)
    expect(page.get_by_label("Log", exact=True).last).to_have_value("b")
    expect(page.get_by_label("Log", exact=True).last).to_be_visible()


def test_nothing_is_split_while_the_regions_are_not_on_the_page(page):
    page.locator("tr[data-node=n2] .swatch").click()
    page.evaluate(LOOK_BACK)
    page.keyboard.press("s")
    page.keyboard.press("/")
    expect(page.locator("#search")).to_be_focused()
    assert page.evaluate(CUTTING) is None
