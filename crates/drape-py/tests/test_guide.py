"""The examples of the guide and of the README run as they stand."""

import re
import shutil

import pytest

BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page", ["crates/drape/guide/src/python.md", "crates/drape-py/README.md"])
def test_the_examples_of_a_page_run(page, root, tmp_path, monkeypatch):
    shutil.copytree(root / "fabrics", tmp_path / "fabrics")
    (tmp_path / "scenes").mkdir()
    shutil.copy(root / "scenes/curtain.toml", tmp_path / "scenes")
    patterns = "crates/drape-pattern/patterns"
    shutil.copytree(root / patterns, tmp_path / patterns)
    monkeypatch.chdir(tmp_path)
    names = {}
    blocks = BLOCK.findall((root / page).read_text(encoding="utf-8"))
    assert blocks
    for block in blocks:
        exec(compile(block, page, "exec"), names)
    assert names["run"].status == "ok" and len(names["run"].frames) > 10
