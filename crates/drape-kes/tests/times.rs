//! Times of the points of a curve, where its file has a column of them.

use drape_kes::Sheet;

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
