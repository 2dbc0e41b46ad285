//! Page of a fabric: its laws with the loops that an ideal instrument would draw.

use drape_fabric::{
    BendingBackbone, BlimanSorine, Fabric, Piecewise, ShearBackbone, TractionBackbone,
    TractionFriction, Varying,
};
use drape_fit::parameter_key;
use drape_kes::{Curve, Direction, Sheet, Test};
use drape_report::{FitPage, Interval, LawReport, Parameter, Quantity};
use drape_validate::instrument;

use super::VERSION;
use super::loop_plot::{Loads, loop_plot};
use super::quantity::DIRECTIONS;
use super::{kes_value, quantity};

/// Number of points of a branch of a loop. With these points the trapezoids of WT are right to a
/// hundred-thousandth.
const POINTS: usize = 400;

/// Tests of a fabric, in the order of the pages.
pub const TESTS: [Test; 3] = [Test::Tensile, Test::Bending, Test::Shear];

/// Returns the directions in which a `test` differs. There is one law of shear.
pub fn directions(test: Test) -> &'static [Direction] {
    if test == Test::Shear { &DIRECTIONS[..1] } else { &DIRECTIONS }
}

/// Returns the page of a `fabric`, with the loops that an ideal instrument would draw and the
/// values of the `sheet`, if there is one.
#[must_use]
pub fn show_page(fabric: &Fabric, sheet: Option<&Sheet>) -> FitPage {
    let given = |name: &str, value: f64, units| Quantity {
        name: name.into(),
        value,
        units,
        origin: String::new(),
    };

    let mut quantities = vec![
        given("mass per area", fabric.density, quantity::mass()),
        given("thickness", fabric.thickness, quantity::thickness()),
        given("surface friction", fabric.surface_friction, quantity::ratio()),
    ];
    if let Some(linearity) = fabric.compression_linearity {
        let pressed = fabric.thickness_under_pressure();
        quantities.push(given("thickness at 50 gf/cm²", pressed, quantity::thickness()));
        quantities.push(given("compression linearity", linearity, quantity::ratio()));
    }

    match sheet {
        Some(sheet) => quantities.extend(sheet.listed().iter().map(kes_value::listed)),
        None => quantities.extend(fabric.provenance.iter().flat_map(|p| {
            p.unused.iter().map(|(symbol, value)| kes_value::unused(symbol, *value))
        })),
    }

    let laws = TESTS.into_iter().flat_map(|test| {
        directions(test).iter().map(move |&direction| law(fabric, test, direction))
    });
    FitPage {
        name: fabric.name.clone(),
        source: fabric.source.clone(),
        provenance: fabric.provenance.as_ref().map_or(String::new(), |p| {
            format!("from the sheet \"{}\" by {}", p.sheet, p.fitted_by)
        }),
        version: VERSION.into(),
        quantities,
        laws: laws.collect(),
        values: DIRECTIONS
            .iter()
            .flat_map(|&direction| kes_value::of_fabric(fabric, direction))
            .collect(),
        assumed: fabric.provenance.as_ref().map_or(Vec::new(), |p| p.assumed.clone()),
        ..FitPage::default()
    }
}

/// Returns the loop that an ideal instrument draws of a `fabric` in a `test`. A fabric out of
/// range, whose loads are not finite, has no loop.
pub fn loop_of(fabric: &Fabric, test: Test, direction: Direction) -> Option<Curve> {
    instrument::ideal(fabric, test, direction, POINTS).ok()
}

/// Returns the law of a `fabric` for a `test`, with its loop and its parameters.
pub fn law(fabric: &Fabric, test: Test, direction: Direction) -> LawReport {
    let curve = loop_of(fabric, test, direction);
    let title = match test {
        Test::Shear => test.name().to_owned(),
        _ => format!("{}, {}", test.name(), direction.name()),
    };
    let errors = fabric.provenance.as_ref().map(|provenance| &provenance.standard_errors);
    let parameter = |parameter: NamedValue| {
        let named = quantity::parameter(test, parameter.name);
        let key = parameter_key(test, direction, parameter.name);
        Parameter {
            name: named.words.into(),
            symbol: named.symbol.into(),
            value: parameter.value,
            units: named.units,
            standard_error: key.and_then(|key| errors?.get(&key).copied()),
            interval: Interval::Fixed { reason: String::new() },
            incidental: named.incidental,
        }
    };

    let plot = curve.map(|curve| {
        loop_plot(title.clone(), &curve, |i| Loads {
            fitted: Some(curve.load()[i]),
            ..Loads::default()
        })
    });
    LawReport {
        plots: plot.into_iter().collect(),
        parameters: parameters(fabric, test, direction).into_iter().map(parameter).collect(),
        title,
        ..LawReport::default()
    }
}

/// Parameter of a law under the name that a fit gives it.
struct NamedValue {
    name: &'static str,
    value: f64,
}

/// Returns `values` as a list.
fn named<const N: usize>(values: [(&'static str, f64); N]) -> Vec<NamedValue> {
    values.map(|(name, value)| NamedValue { name, value }).into()
}

/// Returns the parameters of the law of a `fabric` for a `test`: of its backbone, then of its
/// friction.
fn parameters(fabric: &Fabric, test: Test, direction: Direction) -> Vec<NamedValue> {
    let laws = match direction {
        Direction::Warp => &fabric.warp,
        Direction::Weft => &fabric.weft,
    };

    let (mut all, friction) = match test {
        Test::Tensile => {
            let backbone = match laws.traction.backbone {
                TractionBackbone::Exponential(toe) => named([
                    ("toe_stiffness", toe.stiffness),
                    ("steepness", toe.steepness),
                    ("toe_end", toe.toe_strain),
                    ("toe_growth", toe.toe_strain_after / toe.toe_strain),
                    ("base_stiffness", toe.base_stiffness),
                ]),
                TractionBackbone::Primed(primed) => named([
                    ("stiffness", primed.stiffness),
                    ("toe_ratio", primed.toe_ratio),
                    ("toe_strain", primed.toe_strain),
                    ("toe_growth", primed.toe_strain_after / primed.toe_strain),
                ]),
                TractionBackbone::Polynomial(p) => {
                    named([("quadratic", p.quadratic), ("quartic", p.quartic)])
                }
            };
            (backbone, traction_friction(&laws.traction.friction))
        }
        Test::Bending | Test::LoopBending => {
            let backbone = match laws.bending.backbone {
                BendingBackbone::Linear { rigidity } => named([("rigidity", rigidity)]),
                BendingBackbone::Varying(varying) => varying_stiffness(&varying),
                BendingBackbone::Piecewise(p) => piecewise(&p),
            };
            (backbone, elements(&laws.bending.friction))
        }
        Test::Shear => {
            let mut backbone = match fabric.shear.backbone {
                ShearBackbone::Linear { stiffness } => named([("stiffness", stiffness)]),
                ShearBackbone::Varying(varying) => varying_stiffness(&varying),
                ShearBackbone::Piecewise(p) => piecewise(&p),
            };
            backbone.push(NamedValue { name: "growth", value: fabric.shear.growth });
            (backbone, elements(&fabric.shear.friction))
        }
    };

    all.extend(friction);
    all
}

/// Returns the parameters of the `friction` of traction.
fn traction_friction(friction: &TractionFriction) -> Vec<NamedValue> {
    match friction {
        TractionFriction::Plateau(friction) => elements(friction),
        TractionFriction::Proportional(friction) => named([
            ("friction_ratio", friction.ratio),
            ("friction_plateau", friction.plateau),
            ("friction_length", friction.length),
        ]),
    }
}

/// Returns the parameters of a `law` with varying stiffness.
fn varying_stiffness(law: &Varying) -> Vec<NamedValue> {
    named([
        ("initial_stiffness", law.initial_stiffness),
        ("final_stiffness", law.final_stiffness),
        ("transition", law.transition),
    ])
}

/// Returns the parameters of a piecewise `law`.
fn piecewise(law: &Piecewise) -> Vec<NamedValue> {
    named([("slope", law.slope), ("intercept", law.intercept), ("knot", law.knot)])
}

/// Returns the parameters of the elements of a `friction`. The parameters of the second element
/// have other names.
fn elements(friction: &BlimanSorine) -> Vec<NamedValue> {
    let names = [["plateau", "length"], ["second plateau", "second length"]];
    let pairs = friction.elements.iter().zip(names).filter(|(element, _)| element.plateau != 0.0);
    pairs
        .flat_map(|(element, [plateau, length])| {
            named([(plateau, element.plateau), (length, element.length)])
        })
        .collect()
}
