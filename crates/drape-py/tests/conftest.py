"""Paths that the tests share."""

import os
import shutil
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]

SCENE = """
name = "towel"
spacing = 0.01
fabric.cupro.file = "fabrics/cupro-weave/sheet.toml"
panel = [{ name = "towel", fabric = "cupro", rectangle = [0.2, 0.3] }]
pin = [{ panel = "towel", edge = "top" }]
time = { step = 0.002, end = 0.1 }
output = { every = 0.02 }
"""


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--slow", action="store_true", help="runs tests that take minutes, too")


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "slow: takes minutes; --slow runs it")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if not config.getoption("--slow"):
        for item in items:
            if "slow" in item.keywords:
                item.add_marker(pytest.mark.skip(reason="takes minutes; --slow runs it"))


@pytest.fixture
def root() -> Path:
    """Root of the repository."""
    return ROOT


@pytest.fixture
def towel(tmp_path: Path) -> Path:
    """File of a small scene, with its fabric beside it."""
    shutil.copytree(ROOT / "fabrics/cupro-weave", tmp_path / "fabrics/cupro-weave")
    path = tmp_path / "towel.toml"
    path.write_text(SCENE)
    return path


@pytest.fixture(scope="session")
def command() -> Path:
    """The command, which `cargo build --release` has built."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    path = target / "release/drape"
    assert path.exists(), f"build {path} first: cargo build --release"
    return path
