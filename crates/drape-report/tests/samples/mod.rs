//! Samples of reports, and how to read them back.

#![allow(dead_code, reason = "each test file uses some of them")]

use drape_report::plot::{
    Axis, Branch, BranchKind, Correlation, GraphPlot, GraphSeries, Look, LoopPlot, OverlayPlot,
    Point, Trace,
};
use drape_report::{
    FitPage, Interval, KesValue, LawReport, LawValue, ModelScore, Parameter, Quantity, Statistics,
    Units,
};

pub const GRAM_FORCE_PER_CM: f64 = 0.980_665;

/// A loop that a bent strip would give: out, back and out again, with a law 2 % of the range below
/// it.
pub fn a_loop() -> LoopPlot {
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
        law: "fitted law".to_owned(),
        marks: Vec::new(),
    }
}

pub fn parameter(symbol: &str, interval: Interval) -> Parameter {
    Parameter {
        name: "bending rigidity".to_owned(),
        symbol: symbol.to_owned(),
        value: 1.157e-5,
        units: Units::si("N·m").with_kes("gf·cm²/cm", 9.80665e-5),
        standard_error: Some(2.3e-7),
        interval,
        incidental: false,
    }
}

pub fn a_page() -> FitPage {
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
        values: vec![LawValue {
            symbol: "2HB".to_owned(),
            name: "bending loop width".to_owned(),
            units: Units::si("N").with_kes("gf·cm/cm", 9.80665e-3),
            law: 0.1245 * 9.80665e-3,
            curve: Some(0.112 * 9.80665e-3),
            interval: Interval::Between { lower: 0.11 * 9.80665e-3, upper: 0.13 * 9.80665e-3 },
        }],
        models: vec![ModelScore {
            name: "first order".to_owned(),
            parameters: 3,
            misfit: 0.0123,
            aicc: -812.4,
            prediction: None,
            chosen: true,
        }],
        parameters: vec![
            parameter("k_b", Interval::Between { lower: 1.113e-5, upper: 1.203e-5 }),
            parameter("x_f", Interval::Unknown { reason: "at its lower bound".to_owned() }),
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

pub fn an_overlay() -> OverlayPlot {
    let trace = |label: &str, slope: f64| Trace {
        label: label.to_owned(),
        points: (0..10).map(|k| [f64::from(k) * 0.01, f64::from(k) * slope]).collect(),
    };
    OverlayPlot {
        title: "tensile".to_owned(),
        deformation: Axis::new("strain", "%", 0.01),
        load: Axis::new("tension", "gf/cm", GRAM_FORCE_PER_CM),
        fabrics: vec!["A".to_owned(), "B".to_owned()],
        traces: vec![vec![trace("warp", 2.0), trace("weft", 3.0)], vec![trace("weft", 4.0)]],
    }
}

/// Errors of a strip against its spacing, and the line of the second order, on logarithmic axes.
pub fn a_graph() -> GraphPlot {
    let order = |spacing: f64| 0.4 * spacing * spacing;
    let series = |label: &str, look, factor: f64| GraphSeries {
        label: label.to_owned(),
        look,
        points: [0.02, 0.01, 0.005].map(|h| [h, factor * order(h)]).to_vec(),
    };
    GraphPlot {
        title: "error against spacing".to_owned(),
        axes: [Axis::new("spacing", "mm", 1e-3), Axis::new("error", "%", 0.01)],
        categories: Vec::new(),
        logarithmic: [true, true],
        to_scale: false,
        series: vec![series("simulated", Look::Dots, 1.1), series("h²", Look::Exact, 1.0)],
    }
}

/// The page as a tree; an error in the markup is a failure here.
pub fn tree(page: &str) -> roxmltree::Document<'_> {
    let options =
        roxmltree::ParsingOptions { allow_dtd: true, ..roxmltree::ParsingOptions::default() };
    roxmltree::Document::parse_with_options(page, options).unwrap_or_else(|e| panic!("{e}"))
}

pub fn text_of(node: roxmltree::Node<'_, '_>) -> String {
    node.descendants().filter_map(|n| n.text().filter(|_| n.is_text())).collect()
}

pub fn classes<'a>(node: &roxmltree::Node<'a, '_>) -> Vec<&'a str> {
    node.attribute("class").unwrap_or_default().split(' ').collect()
}
