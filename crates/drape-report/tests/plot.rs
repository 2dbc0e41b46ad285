//! Plots, read back.

#![allow(clippy::unwrap_used)]

mod samples;

use drape_report::plot::{
    Correlation, Mark, UncertaintyPlot, correlation_svg, graph_svg, loop_svg, overlay_svg,
    uncertainty_svg,
};
use samples::{a_graph, a_loop, a_page, an_overlay, classes, tree};

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

/// Value at pixel zero and per pixel, for both axes, from the attributes of the `nth` frame of a
/// plot.
fn inverse(svg: &roxmltree::Document<'_>, nth: usize) -> Vec<f64> {
    let frames = svg.descendants().filter(|n| n.attribute("data-map").is_some());
    let map = frames.clone().nth(nth).unwrap().attribute("data-map").unwrap();
    map.split(' ').map(|number| number.parse().unwrap()).collect()
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
        found.map(|n| pixels(n.attribute("d").unwrap())).collect::<Vec<_>>()
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
            let (q, load) = (point.deformation / 100.0, point.measured.unwrap() / 9.80665e-3);
            assert!((x - q).abs() < 1e-4 * 5.0, "curvature {q} drawn at {x}");
            assert!((y - load).abs() < 1e-4 * 0.6, "moment {load} drawn at {y}");
            let map = inverse(&svg, 1);
            let drawn = map[2] + map[3] * residuals[k][i][1];
            let residual = 100.0 * (point.measured.unwrap() - point.fitted.unwrap()) / range;
            assert!((drawn - residual).abs() < 1e-3, "residual {residual} drawn at {drawn}");
            assert_eq!(measured[k][i][0], residuals[k][i][0], "both frames share the axis");
        }
    }
}

#[test]
fn each_branch_has_its_colour_and_later_cycles_are_paler() {
    let svg = loop_svg(&a_loop()).unwrap();
    let svg = tree(&svg);
    let labelled = svg.descendants().filter(|n| n.attribute("data-label").is_some());
    let found: Vec<_> = labelled
        .map(|n| {
            let opacity: f64 = n.attribute("opacity").unwrap().parse().unwrap();
            (n.attribute("data-label").unwrap(), classes(&n)[1], opacity)
        })
        .collect();
    assert_eq!(found[0], ("loading, cycle 1", "loading", 1.0));
    assert_eq!(found[1], ("unloading, cycle 1", "unloading", 1.0));
    assert_eq!((found[2].0, found[2].1), ("reversal, cycle 2", "reversal"));
    assert!(found[2].2 < 1.0, "cycle 2 is drawn with opacity {}", found[2].2);
}

#[test]
fn one_direction_has_one_dash_on_both_fabrics() {
    let svg = overlay_svg(&an_overlay()).unwrap();
    let svg = tree(&svg);
    let lines = svg.descendants().filter(|n| n.attribute("data-label").is_some());
    let found: Vec<_> =
        lines.map(|n| (n.attribute("data-label").unwrap(), classes(&n)[1..].to_vec())).collect();
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
    let svg = uncertainty_svg(&UncertaintyPlot { parameters: &parameters }).unwrap();
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
    assert!((ratio - 0.90 / 0.46).abs() < 1e-3, "the bars are in the ratio {ratio}");
    // The title of the axis is below its zero.
    let of = |class: &str, attribute: &str| {
        let node = svg.descendants().find(|n| classes(n) == [class]).unwrap();
        let text = node.attribute(attribute).unwrap().trim_start_matches('M');
        text.split(' ').next().unwrap().parse::<f64>().unwrap()
    };
    let [title, zero] = [of("title", "x"), of("zero", "d")];
    assert!((title - zero).abs() < 1.0, "{title} and {zero}");
}

#[test]
fn points_of_a_graph_are_drawn_where_they_are_on_logarithmic_axes() {
    let plot = a_graph();
    let svg = graph_svg(&plot).unwrap();
    let svg = tree(&svg);
    let frame = svg.descendants().find(|n| n.attribute("data-log").is_some()).unwrap();
    assert_eq!(frame.attribute("data-log"), Some("xy"));
    let map = inverse(&svg, 0);
    let series = svg.descendants().filter(|n| n.attribute("data-label").is_some());
    let series: Vec<_> = series.collect();
    assert_eq!(series.len(), 2);
    // References lie beneath.
    for (node, series) in series.iter().zip(plot.series.iter().rev()) {
        let found = pixels(node.attribute("d").unwrap());
        assert_eq!(found.len(), series.points.len());
        for ([x, y], [spacing, error]) in found.into_iter().zip(series.points.clone()) {
            let [a, b] = [map[0] + map[1] * x, map[2] + map[3] * y].map(|log| 10f64.powf(log));
            assert!((a / (spacing / 1e-3) - 1.0).abs() < 1e-3, "{spacing} m drawn at {a} mm");
            assert!((b / (error / 0.01) - 1.0).abs() < 1e-3, "{error} drawn at {b} %");
        }
    }
    assert_eq!(classes(&series[0]), ["line", "exact"]);
}

/// Returns the bounds of the texts and rectangles that are not rotated: low x and y, high x and y,
/// in px.
fn places(svg: &roxmltree::Document<'_>) -> Vec<[f64; 4]> {
    let number = |node: &roxmltree::Node<'_, '_>, key: &str| {
        node.attribute(key).and_then(|text| text.parse::<f64>().ok())
    };
    let upright = svg.descendants().filter(|node| node.attribute("transform").is_none());
    let place = |node: roxmltree::Node<'_, '_>| {
        let [x, y] = [number(&node, "x")?, number(&node, "y")?];
        let [width, height] = ["width", "height"].map(|key| number(&node, key).unwrap_or(0.0));
        Some([x, y, x + width, y + height])
    };
    upright.filter_map(place).collect()
}

#[test]
fn everything_of_a_plot_is_on_its_page_and_the_page_ends_with_it() {
    let parameters = a_page().laws[0].parameters.clone();
    let n = 6;
    let correlation = Correlation {
        symbols: (0..n).map(|k| format!("p{k}")).collect(),
        matrix: (0..n).map(|i| (0..n).map(|j| if i == j { 1.0 } else { 0.1 }).collect()).collect(),
    };
    for plot in [
        loop_svg(&a_loop()),
        overlay_svg(&an_overlay()),
        graph_svg(&a_graph()),
        uncertainty_svg(&UncertaintyPlot { parameters: &parameters }),
        correlation_svg(&correlation),
    ] {
        let plot = plot.unwrap();
        let svg = tree(&plot);
        let page = svg.root_element().attribute("viewBox").unwrap();
        let page: Vec<f64> = page.split(' ').map(|number| number.parse().unwrap()).collect();
        let [width, height] = [page[2], page[3]];
        let places = places(&svg);
        assert!(
            places.iter().all(|[x, y, right, bottom]| {
                0.0 <= *x && 0.0 <= *y && *right <= width && *bottom <= height
            }),
            "{width} × {height}: {places:?}"
        );
        let end = |k: usize| places.iter().map(|place| place[k]).fold(0.0, f64::max);
        assert!(end(3) > height - 60.0, "{} of {height}", end(3));
    }
}

#[test]
fn cells_of_a_correlation_are_squares_below_the_diagonal() {
    let matrix = vec![vec![1.0, 0.6, -0.9], vec![0.6, 1.0, 0.2], vec![-0.9, 0.2, 1.0]];
    let symbols = ["a", "b", "c"].map(str::to_owned).to_vec();
    let svg = correlation_svg(&Correlation { symbols, matrix }).unwrap();
    let svg = tree(&svg);
    let cells: Vec<[f64; 4]> =
        places(&svg).into_iter().filter(|[x, _, right, _]| right > x).collect();
    let cells: Vec<[f64; 4]> = cells.into_iter().filter(|[x, ..]| *x > 0.0).collect();
    let step = cells[0][2] - cells[0][0];
    let start = [cells[0][0], cells[0][1]];
    let expected = [[0, 0], [0, 1], [1, 1], [0, 2], [1, 2], [2, 2]];
    assert_eq!(cells.len(), expected.len(), "{cells:?}");
    for (cell, place) in cells.iter().zip(expected) {
        for k in 0..2 {
            let away = (cell[k] - start[k]) / step;
            assert!((away - f64::from(place[k])).abs() < 0.3, "{place:?}: {cells:?}");
        }
    }
}

#[test]
fn a_legend_has_each_series_once() {
    let mut plot = a_graph();
    let again = plot.series[1].clone();
    plot.series.push(again);
    let svg = graph_svg(&plot).unwrap();
    let svg = tree(&svg);
    for label in ["simulated", "h²"] {
        let texts = svg.descendants().filter(|node| node.is_text() && node.text() == Some(label));
        assert_eq!(texts.count(), 1, "{label}");
    }
}

#[test]
fn a_mark_has_its_label_beside_its_highest_point_and_residuals_are_below_the_loop() {
    let mut plot = a_loop();
    let points = vec![[-200.0, -1e-3], [100.0, 2e-3], [150.0, 1e-3]];
    plot.marks = vec![Mark { label: "2HB".to_owned(), points }];
    let svg = loop_svg(&plot).unwrap();
    let svg = tree(&svg);
    let mark =
        svg.descendants().find(|n| n.attribute("data-label") == Some("2HB of the sheet")).unwrap();
    let drawn = pixels(mark.attribute("d").unwrap());
    let label = mark.next_siblings().find(|n| n.has_tag_name("text")).unwrap();
    let [x, y] = ["x", "y"].map(|key| label.attribute(key).unwrap().parse::<f64>().unwrap());
    assert!((drawn[1][0] - x).abs() < 10.0 && (drawn[1][1] - y).abs() < 10.0, "{x} {y}: {drawn:?}");
    let ends = |small: bool| -> Vec<f64> {
        let is_drawn = |n: &roxmltree::Node<'_, '_>| {
            n.parent().is_some_and(|own| classes(&own).contains(&"series"))
                && classes(n).contains(&"points")
                && classes(n).contains(&"small") == small
                && !classes(n).contains(&"mark")
        };
        let points = svg.descendants().filter(is_drawn);
        points.flat_map(|n| pixels(n.attribute("d").unwrap())).map(|[_, y]| y).collect()
    };
    let lowest = ends(false).into_iter().fold(0.0, f64::max);
    assert!(ends(true).iter().all(|y| *y > lowest), "{lowest}: {:?}", ends(true));
    let frames = svg.descendants().filter(|n| classes(n) == ["paper"]);
    let number =
        |n: &roxmltree::Node<'_, '_>, key: &str| n.attribute(key).unwrap().parse::<f64>().unwrap();
    let frames: Vec<[f64; 2]> =
        frames.map(|n| [number(&n, "y"), number(&n, "y") + number(&n, "height")]).collect();
    assert!(frames.len() == 2 && frames[0][1] < frames[1][0], "{frames:?}");
}
