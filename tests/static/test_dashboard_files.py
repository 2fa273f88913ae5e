"""The dashboard's files hang together, stay small, and never make HTML of what a user typed."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from app.main import create_app
from app.settings import Settings

STATIC = Path(__file__).resolve().parents[2] / "static"
MODULES = sorted(STATIC.rglob("*.js"))
PAGES = sorted(STATIC.rglob("*.html"))
HELP = sorted((STATIC / "docs").glob("*.md"))
MOST_LINES = 250


def ids(paths: list[Path]) -> list[str]:
    return [str(path.relative_to(STATIC)) for path in paths]


@pytest.mark.parametrize("module", MODULES, ids=ids(MODULES))
def test_every_import_leads_to_a_file_that_exports_it(module: Path):
    for names, target in re.findall(r'import (?:\{([^}]*)\} from )?"([^"]+)"', module.read_text()):
        assert target.startswith("."), "only relative addresses work under any prefix"
        source = (module.parent / target).resolve()
        assert source.is_file(), f"{target} does not exist"
        exported = set(
            re.findall(r"export (?:async )?(?:function|const|class) (\w+)", source.read_text())
        )
        wanted = {name.split(" as ")[0].strip() for name in names.split(",") if name.strip()}
        assert wanted <= exported


@pytest.mark.parametrize("module", MODULES, ids=ids(MODULES))
def test_a_module_is_small(module: Path):
    assert len(module.read_text().splitlines()) <= MOST_LINES


@pytest.mark.parametrize("module", MODULES, ids=ids(MODULES))
def test_nothing_is_ever_parsed_as_html_or_as_a_script(module: Path):
    forbidden = r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(|new Function"
    assert re.findall(forbidden, module.read_text()) == []


@pytest.mark.parametrize("path", MODULES + PAGES, ids=ids(MODULES + PAGES))
def test_nothing_is_fetched_from_elsewhere_or_from_the_servers_root(path: Path):
    text = path.read_text().replace("http://www.w3.org/2000/svg", "")
    assert re.findall(r"https?://[^\s\"'`]+", text) == []
    assert re.findall(r'(?:src|href|fetch\()\s*[=(]?\s*"/[^"]*"', text) == []


@pytest.mark.parametrize("page", PAGES, ids=ids(PAGES))
def test_what_a_page_refers_to_exists(page: Path):
    # The API page is served as /docs, from the folder above.
    base = STATIC if page.parent.name == "api" else page.parent
    for target in re.findall(r'(?:src|href)="([^"#]+)"', page.read_text()):
        if target not in ("./", "../", "openapi.json"):
            assert (base / target).exists(), target


@pytest.mark.parametrize("page", HELP, ids=ids(HELP))
def test_links_of_a_help_page_lead_somewhere(page: Path):
    for target in re.findall(r"\]\(([^)]+)\)", page.read_text()):
        if target.startswith("#"):
            assert (page.parent / f"{target[1:]}.md").is_file()
        elif target != "../docs":
            assert (page.parent / target).is_file(), target


def test_every_help_page_is_in_the_menu():
    menu = (STATIC / "docs/help.js").read_text()
    for page in HELP:
        assert re.search(rf'["{{ ]{re.escape(page.stem)}["]?:', menu), page.stem


def test_every_address_in_the_curl_examples_is_served(tmp_path: Path):
    served = create_app(Settings(data=tmp_path)).openapi()["paths"]
    patterns = [re.sub(r"\{[^}]+\}", "[A-Z_]+", path) for path in served]
    text = (STATIC / "docs/api.md").read_text()
    addresses = re.findall(r"http://127\.0\.0\.1:8000(/api/[\w./]+)", text)
    assert len(addresses) >= 8
    for address in addresses:
        assert any(re.fullmatch(pattern, address) for pattern in patterns), address
