//! Times of the points of a curve, where its file has a column of them.

use drape_kes::{Sheet, SheetDraft};

/// Points of the curve: up to 4 % and back.
const COUNT: usize = 41;

/// Reads a curve whose points have a `time` each, below a `heading`.
fn read(heading: &str, time: impl Fn(usize) -> String) -> Sheet {
    let mut text = format!("{heading},Strain (%),Force (N)\n");
    for index in 0..COUNT {
        let strain = 0.2 * index.min(COUNT - 1 - index) as f64;
        let stiffness = if index <= COUNT / 2 { 30.0 } else { 25.0 };
        text += &format!("{},{strain},{}\n", time(index), stiffness * strain);
    }
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("strip.csv"), text).expect("written");
    let sheet = "name = \"strip\"\n[[curve]]\ntest = \"tensile\"\ndirection = \"warp\"\n\
                 file = \"strip.csv\"\nload = { width = \"200 mm\" }\n";
    std::fs::write(folder.path().join("sheet.toml"), sheet).expect("written");
    Sheet::read(folder.path()).expect("a sheet")
}

#[test]
fn times_of_the_points_are_read_where_a_column_has_them() {
    let wanted: Vec<f64> = (0..COUNT).map(|index| 0.25 * index as f64).collect();
    for heading in ["Time (s)", "Zeit [s]", "時間(s)", "Time_min", "Elapsed time"] {
        let sheet = read(heading, |index| format!("{}", 0.25 * index as f64));
        assert_eq!(sheet.curves[0].time(), Some(&wanted[..]), "{heading}");
    }
}

#[test]
fn times_that_do_not_rise_or_are_no_numbers_cost_nothing() {
    for time in ["12:00:01", "", "3"] {
        let sheet = read("Time", |_| time.to_owned());
        assert_eq!(sheet.curves[0].time(), None, "{time}");
        assert_eq!(sheet.curves[0].load().len(), COUNT);
    }
}

#[test]
fn a_column_of_times_has_a_use_with_and_without_its_unit() {
    for (heading, is_used) in
        [("Time (s)", true), ("Time", true), ("経過時間", true), ("Channel 3", false)]
    {
        let mut text = format!("{heading},Strain (%),Force (gf/cm)\n");
        for index in 0..COUNT {
            let strain = 0.2 * index.min(COUNT - 1 - index) as f64;
            text += &format!("{},{strain},{}\n", 0.25 * index as f64, 30.0 * strain);
        }
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("tensile-warp.csv"), text).expect("written");
        let draft = SheetDraft::of_folder(folder.path(), folder.path()).expect("a draft");
        let curve = &draft.read(folder.path()).expect("it is read").curves[0];
        assert_eq!(curve.time().is_some(), is_used, "{heading}");
        let is_unused = draft.notes.iter().any(|note| note.contains("columns without a use"));
        assert_eq!(is_unused, !is_used, "{heading}: {:?}", draft.notes);
    }
}
