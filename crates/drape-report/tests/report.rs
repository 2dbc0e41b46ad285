//! Reports and plots, read back.

#![allow(clippy::unwrap_used)]

use drape_report::plot::{
    Axis, Branch, BranchKind, Correlation, LoopPlot, OverlayPlot, Point, Trace, UncertaintyPlot,
    correlation_svg, loop_svg, overlay_svg, uncertainty_svg,
};
use drape_report::{
    ComparePage, ComparedValue, FabricName, FitPage, Interval, KesValue, LawReport, ModelScore,
    Parameter, Quantity, ReportError, Statistics, Units,
};
use proptest::prelude::*;

const GRAM_FORCE_PER_CM: f64 = 0.980_665;

/// A loop that a bent strip would give: out, back and out again, with a law 2 % of the range below it.
fn a_loop() -> LoopPlot {
    let branch = |kind, cycle, from: f64, to: f64, friction: f64| Branch {
        kind,
        cycle,
        points: (0..=20)
            .map(|k| {
                let q = from + (to - from) * f64::from(k) / 20.0;
                let load = 1e-5 * q + friction;
                Point {
                    deformation: q,
                    measured: Some(load),
                    fitted: Some(load - 0.02 * 5.4e-3),
                    band: Some([load - 2e-4, load]),
                }
            })
            .collect(),
    };
    LoopPlot {
        title: "bending, warp".to_owned(),
        deformation: Axis::new("curvature", "1/cm", 100.0),
        load: Axis::new("moment per width", "gf·cm/cm", 9.80665e-3),
        branches: vec![
            branch(BranchKind::Loading, 1, -250.0, 250.0, 2e-4),
            branch(BranchKind::Unloading, 1, 250.0, -250.0, -2e-4),
            branch(BranchKind::Reversal, 2, -250.0, 250.0, 2e-4),
        ],
    }
}

fn parameter(symbol: &str, interval: Interval) -> Parameter {
    Parameter {
        name: "bending rigidity".to_owned(),
        symbol: symbol.to_owned(),
        value: 1.157e-5,
        units: Units::si("N·m").with_kes("gf·cm²/cm", 9.80665e-5),
        standard_error: Some(2.3e-7),
        interval,
    }
}

fn a_page() -> FitPage {
    let law = LawReport {
        title: "bending, warp".to_owned(),
        model: "line and friction of first order".to_owned(),
        plots: vec![a_loop()],
        statistics: Some(Statistics {
            misfit: 0.0123,
            rms: 6.6e-5,
            r_squared: 0.9987,
            points: 63,
            iterations: 23,
            evaluations: 187,
            converged: true,
            stop: "the sum of squares no longer falls".to_owned(),
        }),
        models: vec![ModelScore {
            name: "first order".to_owned(),
            parameters: 3,
            misfit: 0.0123,
            aicc: -812.4,
            chosen: true,
        }],
        parameters: vec![
            parameter(
                "k_b",
                Interval::Between {
                    lower: 1.113e-5,
                    upper: 1.203e-5,
                },
            ),
            parameter(
                "x_f",
                Interval::Unknown {
                    reason: "at its lower bound".to_owned(),
                },
            ),
        ],
        correlation: Some(Correlation {
            symbols: vec!["k_b".to_owned(), "x_f".to_owned()],
            matrix: vec![vec![1.0, -0.83], vec![-0.83, 1.0]],
        }),
        notes: Vec::new(),
    };
    FitPage {
        name: "poplin".to_owned(),
        source: "the laboratory".to_owned(),
        provenance: "sheet.toml".to_owned(),
        version: "drape 0.1.0".to_owned(),
        quantities: vec![Quantity {
            name: "mass per area".to_owned(),
            value: 0.1056,
            units: Units::si("kg/m²").with_kes("mg/cm²", 0.01),
            origin: "sheet".to_owned(),
        }],
        laws: vec![law],
        values: vec![KesValue {
            symbol: "2HB".to_owned(),
            name: "bending loop width".to_owned(),
            direction: "warp".to_owned(),
            units: Units::si("N").with_kes("gf·cm/cm", 9.80665e-3),
            sheet: Some(0.124 * 9.80665e-3),
            curve: Some(0.112 * 9.80665e-3),
            law: Some(0.1245 * 9.80665e-3),
        }],
        assumed: vec!["thickness: 0.4 mm taken".to_owned()],
        ..FitPage::default()
    }
}

fn an_overlay() -> OverlayPlot {
    let trace = |label: &str, slope: f64| Trace {
        label: label.to_owned(),
        points: (0..10)
            .map(|k| [f64::from(k) * 0.01, f64::from(k) * slope])
            .collect(),
    };
    OverlayPlot {
        title: "tensile".to_owned(),
        deformation: Axis::new("strain", "%", 0.01),
        load: Axis::new("tension", "gf/cm", GRAM_FORCE_PER_CM),
        fabrics: ["A".to_owned(), "B".to_owned()],
        traces: [
            vec![trace("warp", 2.0), trace("weft", 3.0)],
            vec![trace("weft", 4.0)],
        ],
    }
}

/// The page as a tree; an error in the markup is a failure here.
fn tree(page: &str) -> roxmltree::Document<'_> {
    let options = roxmltree::ParsingOptions {
        allow_dtd: true,
        ..roxmltree::ParsingOptions::default()
    };
    roxmltree::Document::parse_with_options(page, options).unwrap_or_else(|e| panic!("{e}"))
}

fn text_of(node: roxmltree::Node<'_, '_>) -> String {
    node.descendants()
        .filter_map(|n| n.text().filter(|_| n.is_text()))
        .collect()
}

fn classes<'a>(node: &roxmltree::Node<'a, '_>) -> Vec<&'a str> {
    node.attribute("class")
        .unwrap_or_default()
        .split(' ')
        .collect()
}

/// The pixels of a path's data.
fn pixels(data: &str) -> Vec<[f64; 2]> {
    let moves = data.split(['M', 'L']).filter(|part| !part.is_empty());
    moves
        .map(|part| {
            let part = part.trim_end_matches("h0").trim_end_matches('Z');
            let (x, y) = part.split_once(' ').unwrap();
            [x.parse().unwrap(), y.parse().unwrap()]
        })
        .collect()
}

/// What the `nth` frame of a plot says about pixels: value at pixel zero and per pixel, for both axes.
fn inverse(svg: &roxmltree::Document<'_>, nth: usize) -> Vec<f64> {
    let frames = svg
        .descendants()
        .filter(|n| n.attribute("data-map").is_some());
    let map = frames
        .clone()
        .nth(nth)
        .unwrap()
        .attribute("data-map")
        .unwrap();
    map.split(' ')
        .map(|number| number.parse().unwrap())
        .collect()
}

#[test]
fn measured_points_and_residuals_are_drawn_where_they_were_measured() {
    let plot = a_loop();
    let svg = loop_svg(&plot).unwrap();
    let svg = tree(&svg);
    let series = |small: bool| {
        let found = svg.descendants().filter(move |n| {
            n.parent().is_some_and(|p| classes(&p).contains(&"series"))
                && classes(n).contains(&"points")
                && classes(n).contains(&"small") == small
        });
        found
            .map(|n| pixels(n.attribute("d").unwrap()))
            .collect::<Vec<_>>()
    };
    let loads: Vec<f64> = plot.points().map(|p| p.measured.unwrap()).collect();
    let highest = loads.iter().copied().fold(f64::MIN, f64::max);
    let range = highest - loads.iter().copied().fold(f64::MAX, f64::min);
    let (measured, residuals) = (series(false), series(true));
    assert_eq!((measured.len(), residuals.len()), (3, 3));
    for (k, branch) in plot.branches.iter().enumerate() {
        assert_eq!(measured[k].len(), branch.points.len());
        for (i, point) in branch.points.iter().enumerate() {
            let map = inverse(&svg, 0);
            let x = map[0] + map[1] * measured[k][i][0];
            let y = map[2] + map[3] * measured[k][i][1];
            // Paths keep two decimals of a px, on a frame of some hundred px.
            let (q, load) = (
                point.deformation / 100.0,
                point.measured.unwrap() / 9.80665e-3,
            );
            assert!((x - q).abs() < 1e-4 * 5.0, "curvature {q} drawn at {x}");
            assert!((y - load).abs() < 1e-4 * 0.6, "moment {load} drawn at {y}");
            let map = inverse(&svg, 1);
            let drawn = map[2] + map[3] * residuals[k][i][1];
            let residual = 100.0 * (point.measured.unwrap() - point.fitted.unwrap()) / range;
            assert!(
                (drawn - residual).abs() < 1e-3,
                "residual {residual} drawn at {drawn}"
            );
            assert_eq!(
                measured[k][i][0], residuals[k][i][0],
                "both frames share the axis"
            );
        }
    }
}

#[test]
fn each_branch_has_its_colour_and_later_cycles_are_paler() {
    let svg = loop_svg(&a_loop()).unwrap();
    let svg = tree(&svg);
    let labelled = svg
        .descendants()
        .filter(|n| n.attribute("data-label").is_some());
    let found: Vec<_> = labelled
        .map(|n| {
            let opacity: f64 = n.attribute("opacity").unwrap().parse().unwrap();
            (n.attribute("data-label").unwrap(), classes(&n)[1], opacity)
        })
        .collect();
    assert_eq!(found[0], ("loading, cycle 1", "loading", 1.0));
    assert_eq!(found[1], ("unloading, cycle 1", "unloading", 1.0));
    assert_eq!((found[2].0, found[2].1), ("reversal, cycle 2", "reversal"));
    assert!(
        found[2].2 < 1.0,
        "cycle 2 is drawn with opacity {}",
        found[2].2
    );
}

#[test]
fn one_direction_has_one_dash_on_both_fabrics() {
    let svg = overlay_svg(&an_overlay()).unwrap();
    let svg = tree(&svg);
    let lines = svg
        .descendants()
        .filter(|n| n.attribute("data-label").is_some());
    let found: Vec<_> = lines
        .map(|n| {
            (
                n.attribute("data-label").unwrap(),
                classes(&n)[1..].to_vec(),
            )
        })
        .collect();
    assert_eq!(
        found,
        [
            ("A, warp", vec!["fabric1", "dash0"]),
            ("A, weft", vec!["fabric1", "dash1"]),
            ("B, weft", vec!["fabric2", "dash1"]),
        ]
    );
}

#[test]
fn uncertainty_bars_reach_as_far_as_the_errors() {
    let parameters = a_page().laws[0].parameters.clone();
    let svg = uncertainty_svg(&UncertaintyPlot {
        parameters: &parameters,
    })
    .unwrap();
    let svg = tree(&svg);
    let bar = |class: &str| {
        let node = svg.descendants().find(|n| classes(n) == [class]).unwrap();
        let data = node.attribute("d").unwrap()[1..].to_owned();
        let (from, to) = data.split_once('H').unwrap();
        let from = from.split_once(' ').unwrap().0;
        to.parse::<f64>().unwrap() - from.parse::<f64>().unwrap()
    };
    // The interval is 0.90 wide where two standard errors are 0.46.
    let (interval, error) = (bar("interval"), bar("error"));
    let ratio = interval / error;
    assert!(
        (ratio - 0.90 / 0.46).abs() < 1e-3,
        "the bars are in the ratio {ratio}"
    );
}

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
    assert_eq!(
        tree.descendants()
            .filter(|n| n.has_tag_name("script"))
            .count(),
        1
    );
}

#[test]
fn pages_and_plots_need_no_network() {
    let compared = ComparePage {
        overlays: vec![an_overlay()],
        ..ComparePage::default()
    };
    for page in [a_page().to_html().unwrap(), compared.to_html().unwrap()] {
        for reference in ["http", "//cdn", "@import", "url(", "src="] {
            assert!(!page.contains(reference), "the page holds {reference}");
        }
    }
    let correlation = a_page().laws[0].correlation.clone().unwrap();
    for svg in [
        loop_svg(&a_loop()).unwrap(),
        correlation_svg(&correlation).unwrap(),
    ] {
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
fn what_cannot_be_drawn_is_refused_with_its_place() {
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
    assert!(matches!(error, ReportError::NotFinite { .. }), "{error}");
    let error = refused(&|p| p.laws[0].parameters[0].standard_error = Some(-1.0));
    assert!(matches!(error, ReportError::OutOfRange { .. }), "{error}");
    let error = refused(&|p| {
        p.laws[0].parameters[0].interval = Interval::Between {
            lower: 2.0,
            upper: 1.0,
        };
    });
    assert!(
        matches!(error, ReportError::OutOfRange { value: 1.0, .. }),
        "{error}"
    );
    let error = refused(&|p| p.laws[0].plots[0].branches.clear());
    assert!(matches!(error, ReportError::EmptyPlot { .. }), "{error}");
    let error = refused(&|p| p.laws[0].plots[0].branches[2].points.clear());
    assert!(error.to_string().contains("branch 2"), "{error}");
    let error = refused(&|p| p.laws[0].plots[0].load.in_si = 0.0);
    assert!(
        matches!(error, ReportError::OutOfRange { value: 0.0, .. }),
        "{error}"
    );
    let error = refused(&|p| p.laws[0].correlation.as_mut().unwrap().matrix[1].truncate(1));
    assert!(
        matches!(
            error,
            ReportError::BadMatrix {
                row: 1,
                length: 1,
                ..
            }
        ),
        "{error}"
    );
    let error = refused(&|p| p.laws[0].correlation.as_mut().unwrap().matrix[0][1] = f64::NAN);
    assert!(matches!(error, ReportError::OutOfRange { .. }), "{error}");
    let error = refused(&|p| p.name.push('\u{1b}'));
    assert!(
        matches!(error, ReportError::ControlCharacter { .. }),
        "{error}"
    );
    let error = refused(&|p| {
        *p = FitPage {
            name: "none".to_owned(),
            ..FitPage::default()
        };
    });
    assert!(matches!(error, ReportError::EmptyReport { .. }), "{error}");
    let error = ComparePage::default().to_html().unwrap_err();
    assert!(matches!(error, ReportError::EmptyReport { .. }), "{error}");
    let none = UncertaintyPlot { parameters: &[] };
    let error = uncertainty_svg(&none).unwrap_err();
    assert!(matches!(error, ReportError::EmptyPlot { .. }), "{error}");
}

#[test]
fn the_text_reads_like_a_fitting_report() {
    let text = a_page().to_text().unwrap();
    for line in [
        "[bending, warp]  doubtful",
        "  ! no 95 % interval for x_f",
        "  misfit   1.23 % of the range (rms 0.00673 gf·cm/cm), R² 0.99870, 63 points",
        "  k_b        bending rigidity  0.1180 ± 0.0023  gf·cm²/cm  1.99 %  [0.1135, 0.1227]  1.157e-5  N·m",
        "    x_f: at its lower bound",
        "    k_b, x_f: -0.830",
        "  - thickness: 0.4 mm taken",
    ] {
        assert!(
            text.lines().any(|l| l == line),
            "no line\n{line}\nin\n{text}"
        );
    }
}

#[test]
fn only_values_beyond_the_limit_are_marked() {
    let html = a_page().to_html().unwrap();
    let tree = tree(&html);
    let cells = tree
        .descendants()
        .filter(|n| classes(n).contains(&"difference"));
    let found: Vec<_> = cells
        .map(|n| (text_of(n), classes(&n).contains(&"apart")))
        .collect();
    assert_eq!(
        found,
        [("−9.68 %".to_owned(), true), ("+0.40 %".to_owned(), false)]
    );
}

#[test]
fn two_fabrics_are_compared_by_the_ratio_of_their_values() {
    let page = ComparePage {
        fabrics: ["A", "B"].map(|name| FabricName {
            name: name.to_owned(),
            source: String::new(),
        }),
        values: vec![ComparedValue {
            symbol: "W".to_owned(),
            name: "mass per area".to_owned(),
            direction: String::new(),
            units: Units::si("kg/m²").with_kes("mg/cm²", 0.01),
            values: [Some(0.1), Some(0.23)],
        }],
        ..ComparePage::default()
    };
    let text = page.to_text().unwrap();
    assert!(
        text.contains("W  mass per area  mg/cm²  10.00  23.00   2.30  !"),
        "{text}"
    );
    let html = page.to_html().unwrap();
    assert!(
        html.contains(r#"<span class="apart">2.30</span>"#),
        "{html}"
    );
    tree(&html);
}

#[test]
fn the_machines_report_holds_the_numbers_in_si() {
    let json = serde_json::to_value(a_page()).unwrap();
    let parameter = &json["laws"][0]["parameters"][0];
    assert_eq!(parameter["value"], 1.157e-5);
    assert_eq!(parameter["units"]["si"], "N·m");
    assert_eq!(parameter["interval"]["between"]["lower"], 1.113e-5);
    assert_eq!(
        json["laws"][0]["plots"][0]["branches"][0]["kind"],
        "loading"
    );
}

#[test]
fn a_law_set_from_values_alone_is_drawn_without_residuals() {
    let mut page = a_page();
    let points = page.laws[0].plots[0]
        .branches
        .iter_mut()
        .flat_map(|b| &mut b.points);
    points.for_each(|point| (point.measured, point.band) = (None, None));
    page.laws[0].statistics = None;
    let html = page.to_html().unwrap();
    let tree = tree(&html);
    let frames = tree
        .descendants()
        .filter(|n| n.attribute("data-map").is_some())
        .count();
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
