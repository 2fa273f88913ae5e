"""The import rules of the house, read off the source."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
ORDER = (
    "errors",
    "geometry",
    "progress",
    "wording",
    "sensing",
    "log_readers",
    "mapping",
    "segmentation",
    "topology",
    "localization",
    "pipeline",
)
LEAVES = ("simulation", "evaluation", "exporters")
ONLY_IN = {"viser": "app/viewer", "sqlalchemy": "app/storage"}


def sources(folder: str) -> Iterator[Path]:
    yield from sorted((ROOT / folder).rglob("*.py"))


def imports_of(path: Path) -> set[str]:
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.add(node.module)
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def core_part(module: str) -> str | None:
    parts = module.split(".")
    return parts[1] if parts[0] == "core" and len(parts) > 1 else None


def test_core_never_imports_the_product_or_its_frameworks() -> None:
    for path in sources("core"):
        roots = {name.split(".")[0] for name in imports_of(path)}
        assert not roots & {"app", "fastapi", "viser", "sqlalchemy", "uvicorn", "typer"}, path


@pytest.mark.parametrize("part", [*ORDER, *LEAVES])
def test_a_part_of_core_imports_only_from_those_before_it(part: str) -> None:
    allowed = set(ORDER) if part in LEAVES else set(ORDER[: ORDER.index(part) + 1])
    allowed.add(part)
    single = ROOT / "core" / f"{part}.py"
    for path in [single] if single.is_file() else sources(f"core/{part}"):
        for module in imports_of(path):
            target = core_part(module)
            if target in (*ORDER, *LEAVES):
                assert target in allowed, f"{path.relative_to(ROOT)} imports {module}"


@pytest.mark.parametrize(("library", "home"), ONLY_IN.items())
def test_a_library_stays_behind_its_door(library: str, home: str) -> None:
    for path in sources("app"):
        roots = {name.split(".")[0] for name in imports_of(path)}
        if library in roots:
            assert path.relative_to(ROOT).as_posix().startswith(home), path


def test_only_the_settings_look_at_the_environment() -> None:
    for folder in ("app", "core"):
        for path in sources(folder):
            if path.name != "settings.py":
                text = path.read_text(encoding="utf-8")
                assert "os.environ" not in text, path
                assert "getenv" not in text, path
