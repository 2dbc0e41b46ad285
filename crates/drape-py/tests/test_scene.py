"""Scenes are checked as by the command, and mistakes say where they are."""

import subprocess

import pytest

import drape
from conftest import SCENE


def test_a_scene_is_read(towel):
    scene = drape.Scene.read(towel)
    assert scene.name == "towel" and scene.particles == 21 * 31
    assert scene.panels == {"towel": range(0, 21 * 31)}
    assert scene.to_toml() == towel.read_text()


def test_all_mistakes_are_told_with_file_line_and_remedy(towel, command):
    wrong = towel.read_text().replace("spacing = 0.01", "spacing = -1").replace("top", "tip")
    towel.write_text(wrong)
    with pytest.raises(drape.InputError) as caught:
        drape.Scene.read(towel)
    error = caught.value
    assert isinstance(error, drape.Error)
    assert error.file == str(towel) and error.line == 3 and "-1" in error.message
    told = subprocess.run([command, "check", towel], capture_output=True, text=True).stderr
    for mistake in error.mistakes:
        assert mistake.message in told
        assert mistake.remedy is None or mistake.remedy in told
    # What it advises is right.
    towel.write_text(wrong.replace("-1", "0.01").replace("tip", "top"))
    drape.Scene.read(towel)


def test_a_text_is_checked_from_a_folder(towel):
    scene = drape.Scene.from_toml(SCENE, folder=towel.parent)
    assert scene.particles == drape.Scene.read(towel).particles
    with pytest.raises(drape.InputError) as caught:
        drape.Scene.from_toml(SCENE + "gravvity = 1\n", folder=towel.parent)
    assert "gravvity" in caught.value.message and caught.value.file.endswith("<text>")


def test_a_mistake_says_what_it_speaks_of_and_how_to_change_the_file(towel):
    right = towel.read_text()
    towel.write_text(right.replace('fabric = "cupro"', 'fabric = "cupo"'))
    with pytest.raises(drape.InputError) as caught:
        drape.Scene.read(towel)
    [mistake] = caught.value.mistakes
    assert mistake.subject == {"panel": "towel"}
    assert mistake.edits == [
        drape.Edit(file=str(towel), key="panel[0].fabric", old='"cupo"', new='"cupro"')
    ]
    # Any program can make the edit.
    [edit] = mistake.edits
    towel.write_text(towel.read_text().replace(edit.old, edit.new))
    assert towel.read_text() == right
