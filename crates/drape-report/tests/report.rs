//! Pages and texts, read back.

#![allow(clippy::unwrap_used)]

mod samples;

use drape_render::{Scene, Surface, View, render};
use drape_report::plot::{Point, UncertaintyPlot, correlation_svg, loop_svg, uncertainty_svg};
use drape_report::{
    CaptionedPicture, ComparePage, ComparedNumber, ComparedValue, Error, FabricName, FitPage,
    Interval, Units, ValidationCase, ValidationPage, ValidationRow,
};
use proptest::prelude::*;
use samples::{a_graph, a_loop, a_page, an_overlay, classes, text_of, tree};

#[test]
fn names_with_markup_stay_names() {
    let name = r#"<b onclick="x()">R&D's "best" ]]> --> </script>"#.to_owned();
    let mut page = a_page();
    page.name.clone_from(&name);
    page.source.clone_from(&name);
    page.warnings.push(name.clone());
    page.laws[0].title.clone_from(&name);
    page.laws[0].plots[0].title.clone_from(&name);
    page.laws[0].plots[0].load.label.clone_from(&name);
    page.laws[0].parameters[0].symbol.clone_from(&name);
    page.values[0].symbol.clone_from(&name);
    let html = page.to_html().unwrap();
    let tree = tree(&html);
    let heading = tree.descendants().find(|n| n.has_tag_name("h1")).unwrap();
    assert_eq!(text_of(heading), name);
    assert!(!tree.descendants().any(|n| n.attribute("onclick").is_some()));
    assert_eq!(tree.descendants().filter(|n| n.has_tag_name("script")).count(), 1);
}

#[test]
fn pages_and_plots_need_no_network() {
    let compared = ComparePage { overlays: vec![an_overlay()], ..ComparePage::default() };
    for page in [a_page().to_html().unwrap(), compared.to_html().unwrap()] {
        for reference in ["http", "//cdn", "@import", "url(", "src="] {
            assert!(!page.contains(reference), "the page holds {reference}");
        }
    }
    let correlation = a_page().laws[0].correlation.clone().unwrap();
    for svg in [loop_svg(&a_loop()).unwrap(), correlation_svg(&correlation).unwrap()] {
        let namespace = r#"xmlns="http://www.w3.org/2000/svg""#;
        assert!(!svg.replacen(namespace, "", 1).contains("http"), "{svg}");
        assert_eq!(tree(&svg).root_element().tag_name().name(), "svg");
    }
}

#[test]
fn the_same_fit_gives_the_same_bytes() {
    let (a, b) = (a_page(), a_page());
    assert_eq!(a.to_html().unwrap(), b.to_html().unwrap());
    assert_eq!(a.to_text().unwrap(), b.to_text().unwrap());
}

#[test]
fn faults_of_a_report_are_refused_with_their_place() {
    let refused = |change: &dyn Fn(&mut FitPage)| {
        let mut page = a_page();
        change(&mut page);
        let error = page.to_html().unwrap_err();
        assert_eq!(page.to_text().unwrap_err().to_string(), error.to_string());
        error
    };
    let nan = refused(&|p| p.laws[0].plots[0].branches[1].points[3].measured = Some(f64::NAN));
    let expected = "bending, warp: the load at point 3 of branch 1 is NaN";
    assert!(nan.to_string().starts_with(expected), "{nan}");
    let error = refused(&|p| p.laws[0].parameters[0].value = f64::INFINITY);
    assert!(matches!(error, Error::NotFinite { .. }), "{error}");
    let error = refused(&|p| p.laws[0].parameters[0].standard_error = Some(-1.0));
    assert!(matches!(error, Error::OutOfRange { .. }), "{error}");
    let error = refused(&|p| {
        p.laws[0].parameters[0].interval = Interval::Between { lower: 2.0, upper: 1.0 };
    });
    assert!(matches!(error, Error::OutOfRange { value: 1.0, .. }), "{error}");
    let error = refused(&|p| p.laws[0].plots[0].branches.clear());
    assert!(matches!(error, Error::EmptyPlot { .. }), "{error}");
    let error = refused(&|p| p.laws[0].plots[0].branches[2].points.clear());
    assert!(error.to_string().contains("branch 2"), "{error}");
    let error = refused(&|p| p.laws[0].plots[0].load.in_si = 0.0);
    assert!(matches!(error, Error::OutOfRange { value: 0.0, .. }), "{error}");
    let error = refused(&|p| p.laws[0].correlation.as_mut().unwrap().matrix[1].truncate(1));
    assert!(matches!(error, Error::BadMatrix { row: 1, length: 1, .. }), "{error}");
    let error = refused(&|p| p.laws[0].correlation.as_mut().unwrap().matrix[0][1] = f64::NAN);
    assert!(matches!(error, Error::OutOfRange { .. }), "{error}");
    let error = refused(&|p| p.name.push('\u{1b}'));
    assert!(matches!(error, Error::ControlCharacter { .. }), "{error}");
    let error = refused(&|p| {
        *p = FitPage { name: "none".to_owned(), ..FitPage::default() };
    });
    assert!(matches!(error, Error::EmptyReport { .. }), "{error}");
    let error = ComparePage::default().to_html().unwrap_err();
    assert!(matches!(error, Error::EmptyReport { .. }), "{error}");
    let none = UncertaintyPlot { parameters: &[] };
    let error = uncertainty_svg(&none).unwrap_err();
    assert!(matches!(error, Error::EmptyPlot { .. }), "{error}");
}

#[test]
fn the_text_reads_like_a_fitting_report() {
    let text = a_page().to_text().unwrap();
    for line in [
        "[bending, warp]  doubtful",
        "  ! not known to 5.00 %: 2HB (to 11.6 %)",
        "  misfit   1.23 % of the range (rms 0.00673 gf·cm/cm), R² 0.99870, 63 points",
        "  2HB    bending loop width  0.1120  0.1245  gf·cm/cm  11.6 % !  [0.1100, 0.1300]",
        "  k_b        bending rigidity  0.1180 ± 0.0023  gf·cm²/cm  1.99 %  [0.1135, 0.1227]  1.157e-5  N·m",
        "    x_f: at its lower bound",
        "    k_b (bending rigidity) and x_f (bending rigidity): -0.830",
        "  - thickness: 0.4 mm taken",
    ] {
        assert!(text.lines().any(|l| l == line), "no line\n{line}\nin\n{text}");
    }
}

#[test]
fn the_page_has_the_residual_in_the_unit_of_its_plot() {
    let html = a_page().to_html().unwrap();
    let text = text_of(tree(&html).root());
    // 6.6e-5 N over 9.80665e-3 N.
    assert!(text.contains("0.00673 gf·cm/cm"), "{text}");
}

#[test]
fn only_values_beyond_the_limit_are_marked() {
    let html = a_page().to_html().unwrap();
    let tree = tree(&html);
    let cells = tree.descendants().filter(|n| classes(n).contains(&"difference"));
    let found: Vec<_> = cells.map(|n| (text_of(n), classes(&n).contains(&"apart"))).collect();
    let expected = [("−9.68 %", true), ("+0.40 %", false), ("11.6 %", true)];
    assert_eq!(found, expected.map(|(text, apart)| (text.to_owned(), apart)));
}

#[test]
fn the_first_sentence_counts_laws_values_and_assumptions() {
    let said = |change: &dyn Fn(&mut FitPage)| {
        let mut page = a_page();
        change(&mut page);
        text_of(tree(&page.to_html().unwrap()).root_element())
    };
    let one = said(&|_| ());
    let whole = "0 of 1 fitted laws are good, 1 doubtful, 1 KES value differs from the curves, 1 assumption.";
    assert!(one.contains(whole), "{one}");
    // A law that is given has no statistics, and is not judged.
    let more = said(&|page| {
        let mut given = page.laws[0].clone();
        given.statistics = None;
        page.laws.push(given);
        page.laws.push(page.laws[0].clone());
        page.values.clear();
        page.assumed.push("shear: as of the warp".to_owned());
    });
    assert!(more.contains("0 of 2 fitted laws are good, 2 doubtful, 2 assumptions."), "{more}");
    let none = said(&|page| {
        page.laws.clear();
        page.values.clear();
        page.assumed.clear();
    });
    assert!(none.contains("Nothing was fitted; the numbers are as given."), "{none}");
}

/// Page of masses, each measured with a standard deviation where it is not zero.
fn a_comparison(names: &[&str], masses: &[[f64; 3]]) -> ComparePage {
    let name = |name: &&str| FabricName { name: (*name).to_owned(), source: String::new() };
    let number = |[measured, deviation, law]: &[f64; 3]| ComparedNumber {
        measured: Some(*measured).filter(|own| *own > 0.0),
        deviation: Some(*deviation).filter(|own| *own > 0.0),
        law: Some(*law),
        is_assumed: false,
    };
    ComparePage {
        fabrics: names.iter().map(name).collect(),
        values: vec![ComparedValue {
            symbol: "W".to_owned(),
            name: "mass per area".to_owned(),
            direction: String::new(),
            units: Units::si("kg/m²").with_kes("mg/cm²", 0.01),
            numbers: masses.iter().map(number).collect(),
            is_comparable: true,
        }],
        ..ComparePage::default()
    }
}

#[test]
fn two_fabrics_are_compared_by_the_difference_of_their_values() {
    let page = a_comparison(&["A", "B"], &[[0.0, 0.0, 0.1], [0.0, 0.0, 0.23]]);
    let text = page.to_text().unwrap();
    assert!(text.contains("W  mass per area  mg/cm²  10.00  23.00  +130 %  !"), "{text}");
    let html = page.to_html().unwrap();
    assert!(html.contains(r#"<span class="apart">+130 %</span>"#), "{html}");
    assert!(!html.contains("Measured"), "nothing was measured");
    tree(&html);
}

#[test]
fn three_fabrics_have_what_was_measured_beside_the_laws() {
    let masses = [[0.1, 0.002, 0.1], [0.104, 0.002, 0.105], [0.2, 0.002, 0.2]];
    let page = a_comparison(&["A", "B", "C"], &masses);
    let text = page.to_text().unwrap();
    let row = text.lines().find(|line| line.starts_with("W ")).unwrap();
    let cells: Vec<&str> = row.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect();
    assert_eq!(
        cells[3..],
        [
            "10.00 ± 0.20",
            "10.00",
            "10.40 ± 0.20",
            "10.50",
            "+4.00 %",
            "≈",
            "20.00 ± 0.20",
            "20.00",
            "+100 %",
            "!"
        ]
    );
    assert!(text.contains("≈: within twice"), "{text}");
    let html = page.to_html().unwrap();
    tree(&html);
    assert_eq!(html.matches("<th class=\"n\">Measured</th>").count(), 3);
    assert!(html.contains("swatch c3"), "{html}");
    let json = serde_json::to_value(&page).unwrap();
    let value = &json["values"][0];
    assert_eq!(value["numbers"][1]["deviation"], 0.002);
    assert_eq!(value["differences"][0], serde_json::Value::Null);
    assert_eq!(value["differences"][2]["of"], "measured");
    assert_eq!(value["differences"][1]["is_within_scatter"], true);
}

#[test]
fn the_report_for_programs_holds_the_numbers_in_si() {
    let json = serde_json::to_value(a_page()).unwrap();
    let parameter = &json["laws"][0]["parameters"][0];
    assert_eq!(parameter["value"], 1.157e-5);
    assert_eq!(parameter["units"]["si"], "N·m");
    assert_eq!(parameter["interval"]["between"]["lower"], 1.113e-5);
    assert_eq!(json["laws"][0]["plots"][0]["branches"][0]["kind"], "loading");
}

#[test]
fn a_law_set_from_values_alone_is_drawn_without_residuals() {
    let mut page = a_page();
    let points = page.laws[0].plots[0].branches.iter_mut().flat_map(|b| &mut b.points);
    points.for_each(|point| (point.measured, point.band) = (None, None));
    page.laws[0].statistics = None;
    let html = page.to_html().unwrap();
    let tree = tree(&html);
    let frames = tree.descendants().filter(|n| n.attribute("data-map").is_some()).count();
    assert_eq!(frames, 1);
    assert!(html.contains("not judged"));
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 500,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_data_gives_a_well_formed_page_or_an_error(
        name in any::<String>(),
        numbers in prop::collection::vec(
            prop_oneof![any::<f64>(), -1e3..1e3, Just(0.0), Just(1e90), Just(1e-90), Just(1e-310)], 10),
    ) {
        let mut page = a_page();
        page.name = name;
        let plot = &mut page.laws[0].plots[0];
        plot.branches.truncate(1);
        plot.branches[0].points.truncate(2);
        for (point, n) in plot.branches[0].points.iter_mut().zip(numbers.chunks(3)) {
            *point = Point {
                deformation: n[0],
                measured: Some(n[1]),
                fitted: Some(n[2]),
                band: None,
            };
        }
        page.laws[0].parameters[0].value = numbers[6];
        page.laws[0].parameters[0].standard_error = Some(numbers[7].abs());
        page.laws[0].models[0].aicc = numbers[8];
        page.values[0].sheet = Some(numbers[9]);
        if let Ok(html) = page.to_html() {
            let shown = html.split("<script>").next().unwrap_or_default();
            for none in ["NaN", ">inf", " inf", "-inf", "−inf"] {
                prop_assert!(!shown.contains(none), "{none} for {numbers:?}");
            }
            tree(&html);
            prop_assert!(page.to_text().is_ok());
        }
    }
}

#[test]
fn a_validation_has_its_figures_plots_and_pictures_in_one_page() {
    let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let scene = Scene { cloths: vec![Surface::cloth(&corners, &[[0, 1, 2]])], ..Scene::default() };
    let view = View { width: 40, height: 30, ..View::default() };
    let picture = render(&scene, &view).unwrap();
    let row = |what: &str, passes| ValidationRow {
        what: what.to_owned(),
        measured: "1.01".to_owned(),
        reference: "1".to_owned(),
        error: "+1 %".to_owned(),
        limit: "2 %".to_owned(),
        passes: Some(passes),
    };
    let case = |name: &str, rows| ValidationCase {
        name: name.to_owned(),
        title: format!("{name} & <more>"),
        rows,
        plots: vec![a_graph()],
        pictures: vec![CaptionedPicture {
            caption: "a triangle".to_owned(),
            picture: picture.clone(),
        }],
        ..ValidationCase::default()
    };
    let mut page = ValidationPage {
        version: "drape 0.1.0".to_owned(),
        cases: vec![
            case("good", vec![row("a", true)]),
            case("bad", vec![row("b", true), row("c", false)]),
        ],
        notes: vec!["nothing else".to_owned()],
    };
    let html = page.to_html().unwrap();
    assert_eq!(html, page.to_html().unwrap());
    let tree = tree(&html);
    let found = |tag: &str| tree.descendants().filter(|n| n.has_tag_name(tag)).count();
    assert_eq!((found("svg"), found("img")), (2, 2));
    let image = tree.descendants().find(|n| n.has_tag_name("img")).unwrap();
    // The first bytes of every PNG file.
    let start = "data:image/png;base64,iVBORw0KGgo";
    assert!(image.attribute("src").unwrap().starts_with(start));
    assert!(html.contains("1 of 2 cases are within their limits; 3 figures"), "{html}");
    let failed = tree.descendants().filter(|n| classes(n) == ["failed"]);
    assert_eq!(failed.count(), 1);
    assert!(!html.contains("http"));
    page.cases[0].plots[0].series[0].points[0][0] = f64::NAN;
    assert!(matches!(page.to_html(), Err(Error::NotFinite { .. })));
    let none = ValidationPage::default().to_html();
    assert!(matches!(none, Err(Error::EmptyReport { .. })));
}
