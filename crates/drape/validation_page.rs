//! The outcomes of the validation as pages: HTML with plots and pictures, and the Markdown that is shipped.

use std::path::Path;

use drape::report::plot::{Axis, GraphPlot, GraphSeries, Look, graph_svg};
use drape::report::{Picture, ValidationCase, ValidationPage, ValidationRow};
use drape::validate::{Check, Graph, Kind, Layout, Outcome, Source, Still};

use crate::failure::Failure;
use crate::validate::figure;
use crate::{fabric_page, file, picture};

/// Name of the page in its folder.
pub(crate) const NAME: &str = "validation.html";
/// Pictures of cases that are shipped, as the page in Markdown sees them.
const SHIPPED: [(&str, &str); 1] = [("breen", "../../scenes/cubes.png")];
/// Pixels of one of several pictures.
const FIELD: [u32; 2] = [640, 480];

/// Writes the page, and every plot and picture as a file beside it.
pub(crate) fn store(outcomes: &[Outcome], folder: &Path) -> Result<(), Failure> {
    let cases: Result<Vec<ValidationCase>, Failure> = outcomes.iter().map(case).collect();
    let page = ValidationPage {
        version: fabric_page::VERSION.into(),
        cases: cases?,
        notes: LEFT_OUT.iter().map(|text| text.replace('`', "")).collect(),
    };
    file::write(&folder.join(NAME), page.to_html()?)?;
    for case in &page.cases {
        for (number, plot) in case.plots.iter().enumerate() {
            let path = folder.join(format!("{}-{}.svg", case.name, number + 1));
            file::write(&path, graph_svg(plot)?)?;
        }
        for (number, (_, picture)) in case.pictures.iter().enumerate() {
            let path = folder.join(format!("{}-{}.png", case.name, number + 1));
            file::write(&path, picture.png()?)?;
        }
    }
    Ok(())
}

fn case(outcome: &Outcome) -> Result<ValidationCase, Failure> {
    let drawn = |still: &Still| Ok((still.title.clone(), draw(still)?));
    let pictures: Result<Vec<(String, Picture)>, Failure> =
        outcome.stills.iter().map(drawn).collect();
    Ok(ValidationCase {
        name: outcome.name.clone(),
        title: outcome.title.clone(),
        seconds: outcome.seconds,
        failure: outcome.failure.clone(),
        rows: outcome.checks.iter().map(row).collect(),
        plots: outcome.graphs.iter().map(plot).collect(),
        pictures: pictures?,
    })
}

fn plot(graph: &Graph) -> GraphPlot {
    let series = graph.series.iter().map(|series| GraphSeries {
        label: series.label.clone(),
        look: match series.source {
            Source::Simulated => Look::Dots,
            Source::Traced => Look::Line,
            Source::Reference => Look::Exact,
        },
        points: series.points.clone(),
    });
    GraphPlot {
        title: graph.title.clone(),
        axes: graph.axes.map(|axis| Axis::new(axis.label, axis.unit, axis.in_si)),
        logarithmic: [graph.layout == Layout::Logarithmic; 2],
        to_scale: graph.layout == Layout::ToScale,
        series: series.collect(),
    }
}

/// The cloths of a still on one sheet.
fn draw(still: &Still) -> Result<Picture, Failure> {
    let view = still.view.map(Some);
    let picture = |snapshot| picture::draw(snapshot, view, FIELD);
    let pictures: Result<Vec<Picture>, Failure> = still.snapshots.iter().map(picture).collect();
    Ok(Picture::sheet(&pictures?, still.columns))
}

/// A figure in words and digits.
fn row(check: &Check) -> ValidationRow {
    let Check { what, measured, reference, limit, kind } = check;
    let cells = match kind {
        Kind::Equal => [
            format!("{measured:.5}"),
            format!("{reference:.5}"),
            format!("{:+.3} %", 100.0 * check.error()),
            format!("{} %", 100.0 * limit),
        ],
        Kind::AtLeast => {
            [format!("{measured:.3}"), String::new(), String::new(), format!("≥ {reference}")]
        }
        Kind::AtMost => {
            [figure(*measured), String::new(), String::new(), format!("≤ {}", figure(*reference))]
        }
        Kind::Told => [format!("{measured:.3}"), String::new(), String::new(), "none".to_owned()],
    };
    ValidationRow { what: what.clone(), cells, passes: check.passes() }
}

/// The page that `crates/drape/VALIDATION.md` is.
pub(crate) fn markdown(outcomes: &[Outcome]) -> String {
    let mut page = String::from(
        "# Validation\n\nSimulations against exact solutions and measurements. `drape validate --markdown FILE` \
         writes this page, with `--full` the cases that take minutes too; \
         the references are computed in `crates/drape-validate/src/reference` or cited there. \
         `drape validate --report FOLDER` writes the same with plots and pictures.\n",
    );
    for outcome in outcomes {
        page += &format!("\n## {}\n\n`drape validate {}`\n\n", outcome.title, outcome.name);
        if let Some(failure) = &outcome.failure {
            page += &format!("It could not be run: {failure}\n");
            continue;
        }
        let still = outcome.stills.first().map_or(&outcome.title, |still| &still.title);
        for (_, path) in SHIPPED.iter().filter(|(case, _)| *case == outcome.name) {
            page += &format!("![{still}]({path})\n\n{still}.\n\n");
        }
        page += "| figure | simulated | reference | error | limit | |\n|---|---|---|---|---|---|\n";
        for ValidationRow { what, cells, passes } in outcome.checks.iter().map(row) {
            let verdict = if passes { "pass" } else { "**fail**" };
            let cells = cells.map(|cell| if cell.is_empty() { cell } else { cell + " " });
            page += &format!("| {what} | {}| {verdict} |\n", cells.join("| "));
        }
    }
    page += "\n## What this does not show\n\n";
    LEFT_OUT.iter().for_each(|text| page += &format!("* {}\n", text.replace('\n', "\n  ")));
    page
}

/// What the model leaves out, and what of it is not tested.
const LEFT_OUT: &[&str] = &[
    "The model has no creep and no dependence on the rate: what the friction holds, it holds for ever, and a slow \
     cloth is as stiff as a quick one.",
    "Nothing in it depends on moisture or temperature; a sheet holds for the air it was measured in.",
    "Warp and weft stay where they cross: they turn about their crossings in shear, but do not slide along each \
     other. Stretching one does not shorten the other (no exchange of crimp).",
    "Bending does not depend on tension, nor the fabric's friction on pressure. The fabric is not compressed through \
     its thickness, and does not tear.",
    "In these cases cloth meets bodies at its particles only, and does not meet itself.",
    "Air resists the motion of the cloth, and does not move by itself.",
    "The shear of the fabrics that ship was not published or not measured and is assumed, as the curvature is over \
     which bending friction builds up; every fit prints what it assumed.",
    "Cells that bend on the bias fold along their diagonals, and their corners there shear although the cloth does not: \
     the\nmoment is larger by a part Gκ²h⁴/16(B₁ + B₂). That closed form and the simulated specimens are half a percent \
     of the\nloop apart. For the cupro bent to a radius of 2 cm it is a hundredth at 2.5 mm, a sixth at 5 mm and 2.7 \
     times the moment\nat 10 mm. A strip of 5 cm (16 µN·m, 200 g/m², G = 30 N/m) clamped level and cut at 45° hung with \
     a drop over reach of\n2.57 at 3.4 mm, 1.96 at 6.7 mm and 1.06 at 13 mm, where the heavy elastica has 2.59; along \
     the yarns it was 1.51, 1.49\nand 1.45 at 2.4, 4.8 and 9.1 mm, and should be 1.51. Folds on the bias ask for finer \
     cells than folds along the yarns.",
    "Yarns twist for nothing: a saddle along them stores no energy of bending, so a strip on the bias has \
     B = (B₁ + B₂)/4,\nand a narrow one, whose edges may curl, less. What a fabric's yarns resist to twisting is not in \
     its KES sheet.",
    "What a bent specimen keeps is held against a slow release. Let go at once it springs, and keeps 57 to 69 % of \
     that. A\ncrease keeps a degree or few; fibres that yield and creep at the radius of a yarn are beyond loops of \
     2.5 cm⁻¹.",
    "What an instrument's loop is held against is the law that was fitted, not the measured curve: how well a law \
     follows\na curve is the fit's report. At 10 and 5 mm a bending specimen of 1 cm is one or two cells, all of them \
     held; with free\ncells between (2.5 mm) fabrics whose traction begins soft are 1.5 to 1.8 % off, because a bow \
     also pulls at its yarn\nwith the moment times the curvature, and such a yarn gives way.",
    "The drape coefficients of two fabrics have been compared once. Matsudaira's wool (case `drapemeter-wool`, ten starts for\n\
     each study): 48.5 % with a standard deviation of 1.9, where 49.8 was measured; five to seven nodes, where five were counted;\n\
     46.1 to 53.0 % over what its sheet leaves open, which is shear and the building up of the bending friction; 40.3 % without\n\
     friction; 1.6 points off at 0.7 of the spacing (`grid-wool`). At 4.0, 3.5 and 2.5 mm it is 50.0, 48.5 and 46.9 %: if what\n\
     is off goes with the square of the spacing, 45 % in the end. His cotton (case `drapemeter-cotton`, ten starts for\n\
     each study too): 84.4 % with a standard deviation of 2.0, where 82.9 was measured; five or six nodes, where two were\n\
     counted; 73.7 to 87.5 % over what is open, most of it from the building up of the bending friction (73.9 to 84.3 %);\n\
     62.8 % without friction. This was at 5 mm, and is not what finer grids tend to (`grid-cotton` fails, by 3.2 points for 2):\n\
     30 starts at 4.7 mm drape to 85.2 % with six or five nodes, 13 at 3.3 mm to 82.2 % with six to four, five at 2.3 mm to\n\
     73.9 % with four or five. It is the number of folds that changes, for with as many of them the coefficient hardly does. Whether\n\
     starts are roughened from particle to particle or smoothly over 20 mm moves the mean by 0.4 points or less; at 3.3 mm eight\n\
     of ten have as many folds either way, so the place of the grid on the specimen seems to decide, perhaps because the ragged\n\
     rim of a coarse grid breaks the weave's own fourfold symmetry. Real specimens break it too, by how much is not known.\n\
     Turned on the disc it drapes the same, for the grid lies along the yarns and turns with them. What matters to the cotton (`sensitivity-cotton`, four starts at\n\
     either end), in points: friction or none 22, its 2HB halved or half as much again 18, shaken or not 17, friction that\n\
     builds up over 0.2 or 0.02 1/cm 10, a platform at 200 or at 20 mm/s 9, 2HG of 0 or 2 gf/cm 6, B by 20 % or W by 5 % less or\n\
     more 2 each, G of 0.3 or 1.5 gf/(cm·deg) 1.5, traction halved or doubled 0.4; steps of 10 ms keep 2 more than those of\n\
     2.5 ms. To the wool (`sensitivity-wool`, at 5 mm): G 8.7, friction 7.6, B 6.8, 2HG 6.7, 2HB 6.1, the building up of\n\
     friction 3.5, W 2.6, traction 0.2, shaking 4.8, the platform 2.1, steps of 10 ms 1.1. Without inertia the two keep 6 and 8 points\n\
     more. The speed of the measured ones is not known, nor whether they were shaken.",
    "Breen's fabrics are not published. What stands for his stiff cotton has four times the bending of Matsudaira's \
     cotton broad, and what\nstands for his polyester/cotton a quarter of it along the weft, by choice. That stiff cloth \
     has one billow at a corner, limp cloth\ntwo and cloth with a limp weft slanted ones is so on grids of 2 and of 1 \
     cm; how stiff his cotton was is not known. Matsudaira's\ncotton itself has two, as it would have were it twice as \
     stiff. Breen's photographs are compared in words only.",
    "Breen's particles count their distances in spacings: at 2 cm cloth keeps 2 cm from itself, and neighbours across \
     a cell repel each\nother beyond 30° of shear, on any grid.",
    "The shapes that Tagawa and others photographed are not legible enough to compare.",
];
