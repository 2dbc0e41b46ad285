//! One scene on several grids: limits of its measures, and what keeps them from being found.

use serde_json::Value;

use super::Bench;

/// Time of a run that comes to rest.
const REST: &str = "[time]\nstep = 0.005\nend = 60\n[settle]\nresidual = 1e-4\n";

impl Bench {
    /// Makes the scene one of a strip that is held level at one end, and comes to rest.
    fn cantilever(&self) {
        let (own, _) = super::SCENE.split_once("[time]").unwrap();
        let own = own.replace("turn = [-90, 0, 0]\n", "");
        std::fs::write(self.path("scene.toml"), format!("{own}{REST}")).unwrap();
    }

    fn converged(&self, spacings: &str) -> Value {
        let command = ["converge", "scene.toml", "--spacings", spacings, "--json"];
        serde_json::from_str(&self.ran(&command, 0).0).unwrap()
    }
}

fn measure<'a>(converged: &'a Value, key: &str) -> &'a Value {
    let measures = converged["measures"].as_array().unwrap();
    measures.iter().find(|measure| measure["key"] == key).unwrap()
}

#[test]
fn the_limit_is_that_of_finer_grids() {
    let bench = Bench::new("");
    bench.cantilever();
    let coarse = bench.converged("10,7.1,5");
    let own = measure(&coarse, "energy.gravity");
    let values = own["values"].as_array().unwrap();
    let [limit, uncertainty, finest] =
        [&own["limit"], &own["uncertainty"], &values[2]].map(|own| own.as_f64().unwrap());
    assert!((finest - limit).abs() <= uncertainty, "{own}");
    // The same cloth on a grid half as fine as the finest: nearer the limit than that is.
    let command = ["run", "scene.toml", "--set", "spacing=0.0025", "-o", "fine", "--no-picture"];
    bench.ran(&command, 0);
    let text = std::fs::read_to_string(bench.path("fine/summary.json")).unwrap();
    let fine = serde_json::from_str::<Value>(&text).unwrap()["energy"]["gravity"].as_f64();
    let fine = fine.unwrap();
    assert!((fine - limit).abs() < 0.5 * (finest - limit).abs(), "{fine} {own}");
    let spacings = coarse["spacings"].as_array().unwrap();
    let spacings: Vec<f64> = spacings.iter().map(|own| own["spacing"].as_f64().unwrap()).collect();
    assert!(spacings.iter().zip([0.01, 0.0071, 0.005]).all(|(a, b)| (a - b).abs() < 1e-12));
}

#[test]
fn runs_are_kept_and_more_spacings_run_alone() {
    let bench = Bench::new("");
    let converge = |spacings: &str| {
        bench.ran(&["converge", "scene.toml", "--spacings", spacings, "--results", "grids"], 0).0
    };
    assert!(converge("20,14").contains("2 points: 2 run, 0 done before"));
    let said = converge("20,14,10");
    assert!(said.contains("3 points: 1 run, 2 done before"), "{said}");
    assert!(said.contains("energy.gravity, J: "), "{said}");
    let page = std::fs::read_to_string(bench.path("grids/index.html")).unwrap();
    assert!(page.contains("<h2>energy.gravity, J</h2>"), "each measure has a plot");
    assert!(bench.path("grids/table.csv").is_file());
}

#[test]
fn parts_with_their_own_spacing_keep_its_ratio() {
    let bench = Bench::new("");
    let own = super::SCENE.replace("noise =", "spacing = \"1 cm\"\nnoise =");
    std::fs::write(bench.path("scene.toml"), own).unwrap();
    let counts = |converged: &Value| {
        let own = converged["spacings"].as_array().unwrap();
        own.iter().map(|own| own["particles"].as_f64().unwrap()).collect::<Vec<_>>()
    };
    // The panel has half the spacing of the scene.
    assert_eq!(counts(&bench.converged("20,10")), [5.0 * 11.0, 9.0 * 21.0]);
    let two = super::SCENE.replace(
        "[[pin]]",
        "[[panel]]\nname = \"own\"\nfabric = \"cloth\"\nrectangle = [0.04, 0.1]\ncenter = [1, 0, 0]\n\
         spacing = 0.01\n[[pin]]",
    );
    std::fs::write(bench.path("scene.toml"), two).unwrap();
    let [coarse, middle, fine] = [3.0 * 6.0, 5.0 * 11.0, 9.0 * 21.0];
    assert_eq!(counts(&bench.converged("20,10")), [coarse + middle, middle + fine]);
}

#[test]
fn each_grid_keeps_the_coarser_ones_of_the_scene() {
    let bench = Bench::new("");
    bench.cantilever();
    let scene = std::fs::read_to_string(bench.path("scene.toml")).unwrap();
    let refined = scene + "[refine]\nspacings = [0.02, \"14 mm\"]\n";
    std::fs::write(bench.path("scene.toml"), refined).unwrap();
    let command = ["converge", "scene.toml", "--spacings", "20,14,10", "--results", "grids"];
    bench.ran(&command, 0);
    let table = std::fs::read_to_string(bench.path("grids/table.csv")).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    let grids = |line: &str| line.matches(" mm").count() - 1;
    assert_eq!([1, 2, 3].map(|row| grids(lines[row])), [0, 1, 2], "{table}");
}

#[test]
fn wrong_spacings_and_scenes_are_refused_before_any_run() {
    let bench = Bench::new("");
    for (spacings, part) in [
        ("20", "one spacing says nothing"),
        ("20,19", "take 20.9 mm or more in place of 20"),
        ("20,-3", "-3 is no spacing"),
        ("20,x", "invalid value 'x'"),
    ] {
        let command = ["converge", "scene.toml", &format!("--spacings={spacings}")];
        let (_, messages) = bench.ran(&command, 2);
        assert!(messages.contains(part), "{messages}");
    }
    let command = ["converge", "scene.toml", "--spacings", "20.9,19", "--set", "time.end=0.01"];
    bench.ran(&command, 0);
    let command = ["converge", "scene.toml", "--spacings", "20,10", "--set", "time.step=-1"];
    let (_, messages) = bench.ran(&command, 3);
    assert!(messages.contains("time.step"), "{messages}");
    bench.ran(&["converge", "scene.toml", "--spacings", "20,10", "--set", "time.step=0.005"], 0);
    let (_, messages) = bench
        .ran(&["converge", "scene.toml", "--spacings", "20,10", "--measure", "measures.hem"], 2);
    assert!(messages.contains("measures.hem: no such number"), "{messages}");
    let gravity = ["--measure", "energy.gravity"];
    let command = [&["converge", "scene.toml", "--spacings", "20,10"], &gravity[..]].concat();
    let (said, _) = bench.ran(&command, 0);
    assert_eq!(said.lines().filter(|line| line.contains("limit")).count(), 1, "{said}");
    // The cloth does not come to rest: the page says why, and the exit code that it did not.
    bench.cantilever();
    let command = ["converge", "scene.toml", "--spacings", "20,10", "--set", "time.end=0.01"];
    let (_, messages) = bench.ran(&command, 5);
    assert!(messages.contains("0 of 2 runs came to their end"), "{messages}");
}
