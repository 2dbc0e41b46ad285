"""Arguments of another kind are answered with a sentence that says what to do."""

from pathlib import Path

import pytest

import drape

WRONG = [
    (lambda: drape.Simulation("towel.toml"), "drape.Simulation(drape.Scene.read('towel.toml'))"),
    (lambda: drape.Simulation(Path("towel.toml")), "drape.Scene.read('towel.toml')"),
    (lambda: drape.Simulation(5), "Simulation takes a Scene, not 5 (int)"),
    (lambda: drape.Scene("towel.toml"), "drape.Scene.read('towel.toml') reads a file"),
    (lambda: drape.Scene({"spacing": 0.1}), "drape.SceneBuilder(...).scene() makes one"),
    (lambda: drape.Scene.read(None), "Scene.read takes a path, not None (NoneType)"),
    (lambda: drape.Scene.from_toml({"spacing": 1}), "Scene.from_toml takes a text"),
    (lambda: drape.SceneBuilder("towel"), "name='towel' names the scene"),
    (lambda: drape.SceneBuilder().fabric("wool", 5), "takes a Fabric, a Fit or a path, not 5 (int)"),
    (lambda: drape.Fabric("wool.toml"), "drape.Fabric.read('wool.toml') reads a file"),
    (lambda: drape.Fabric.read(5), "Fabric.read takes a path, not 5 (int)"),
    (lambda: drape.Sheet("wool"), "drape.read_sheet('wool') reads a file"),
    (lambda: drape.Fit("wool"), "drape.fit('wool') fits the sheet of a file"),
    (lambda: drape.Fits("wool", {}), "drape.fit_all('wool') fits the sheets of a folder"),
    (lambda: drape.fit(5), "fit takes a Sheet, a path or a list of Curves, not 5 (int)"),
    (lambda: drape.fit([5]), "a list of curves takes a Curve, not 5 (int)"),
    (lambda: drape.fit_all(5), "fit_all takes paths, not 5 (int)"),
    (lambda: drape.Frames("out/towel"), "drape.open('out/towel').frames"),
    (lambda: drape.Run("out/towel", None), "drape.open('out/towel') opens a stored run"),
    (lambda: drape.View("out/towel"), "drape.view(run) makes one"),
    (lambda: drape.open(5), "open takes a path, not 5 (int)"),
    (lambda: drape.view(5), "view takes a path, not 5 (int)"),
    (lambda: drape.resume(5), "resume takes a path, not 5 (int)"),
    (lambda: drape.resume("out", scene="towel.toml"), "read it first, drape.Scene.read('towel.toml')"),
    (lambda: drape.drapemeter("wool.toml"), "read it first, drape.Fabric.read('wool.toml')"),
    (lambda: drape.convert(5), "convert takes a path, not 5 (int)"),
]


@pytest.mark.parametrize("call, words", WRONG)
def test_a_sentence_says_what_to_do(call, words):
    with pytest.raises(drape.UsageError) as caught:
        call()
    assert words in str(caught.value)


def test_what_the_sentences_advise_works(towel, root, tmp_path):
    scene = drape.Scene.read(str(towel))
    assert len(drape.Simulation(scene).positions) == scene.particles
    fabric = drape.fit(root / "fabrics/tagawa-2003").fabric
    (tmp_path / "f.toml").write_text(fabric.to_toml(), encoding="utf-8")
    assert drape.Fabric.read(tmp_path / "f.toml").name == fabric.name


def test_a_long_argument_is_cut():
    with pytest.raises(drape.UsageError) as caught:
        drape.Simulation("x" * 5000)
    assert len(str(caught.value)) < 300


def test_a_file_of_another_kind_is_named(root, tmp_path):
    with pytest.raises(drape.InputError, match="this is a sheet of measurements, not a scene"):
        drape.Scene.read(root / "fabrics/tagawa-2003/sheet.toml")
    with pytest.raises(drape.InputError, match="this is a scene, not a fabric"):
        drape.Fabric.read(root / "scenes/curtain.toml")
    with pytest.raises(drape.InputError, match="this is a scene, not a sheet"):
        drape.fit(root / "scenes/curtain.toml")
