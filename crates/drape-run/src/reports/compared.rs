//! Page of compared fabrics: measured values of fabrics, with the values of their laws.

use drape_fabric::Fabric;
use drape_fit::{FitSettings, fabric_values};
use drape_kes::{Curve, Direction, EvaluationPoints, Sheet, Symbol, Test};
use drape_report::plot::{OverlayPlot, Trace};
use drape_report::{ComparePage, ComparedNumber, ComparedValue, FabricName, Units};

use super::VERSION;
use super::fabric::{TESTS, directions, loop_of};
use super::loop_plot::trace;
use super::quantity::DIRECTIONS;
use super::sheet_value::deviation;
use super::{kes_value, quantity};

/// Tests whose curves are overlaid, in the order of the page.
const MEASURED: [Test; 4] = [Test::Tensile, Test::Bending, Test::LoopBending, Test::Shear];

/// Largest relative difference of the loads of tensile tests whose values are compared.
const SAME_LOAD: f64 = 0.01;

/// Values that the model does not use, or uses for contact alone, by their symbols.
const OTHERS: [&str; 6] = ["TM", "LC", "WC", "RC", "MMD", "SMD"];

/// Fabric that is compared, with the sheet of its measurements if there is one.
#[derive(Clone, Copy)]
pub struct ComparedFabric<'a> {
    /// Fabric with its laws.
    pub fabric: &'a Fabric,
    /// Measurements of the fabric.
    pub sheet: Option<&'a Sheet>,
}

impl ComparedFabric<'_> {
    /// Returns the points at which KES values are read, by the `sheet`.
    fn points(&self) -> EvaluationPoints {
        FitSettings::default().evaluation_points(self.sheet.unwrap_or(&Sheet::default()))
    }

    /// Returns the numbers of the KES value `symbol` in a `direction`, in SI.
    pub(super) fn number(&self, direction: Direction, symbol: Symbol) -> ComparedNumber {
        let unit = kes_value::units(symbol.name()).kes.map_or(1.0, |unit| unit.in_si);
        let laws = fabric_values(self.fabric, direction, &self.points());
        let law = laws.get(symbol).map(|law| law * unit);
        let Some(sheet) = self.sheet else {
            return ComparedNumber { law, ..ComparedNumber::default() };
        };

        let is_assumed = !is_known(sheet, direction, symbol);
        let stated = sheet.values(direction).get(symbol);
        let [measured, deviation] = match stated {
            Some(value) => [Some(value), deviation(sheet, symbol.name(), direction)],
            None => self.of_curve(sheet, direction, symbol),
        };
        let [measured, deviation] =
            [measured, deviation].map(|number| number.map(|number| number * unit));
        ComparedNumber { measured, deviation, law, is_assumed }
    }

    /// Returns the value `symbol` of a curve of `sheet` and its standard deviation over the
    /// repeats, in the unit of the laboratory.
    fn of_curve(&self, sheet: &Sheet, direction: Direction, symbol: Symbol) -> [Option<f64>; 2] {
        let points = self.points();
        let Some(curve) = sheet.curves_of(symbol.test(), direction).next() else {
            return [None; 2];
        };
        let value_of = |curve: &Curve| {
            let values = curve.values(&points).into_iter();
            values.filter(|read| read.symbol == symbol).find_map(|read| read.value.ok())
        };
        let repeats: Vec<f64> = curve.repeats().iter().filter_map(value_of).collect();
        [value_of(curve), sample_deviation(&repeats)]
    }

    /// Returns the value `symbol` that no law has, in SI. The value has a `direction` or none.
    fn other(&self, symbol: &str, direction: Option<Direction>) -> Option<f64> {
        let unit = kes_value::units(symbol).kes.map_or(1.0, |unit| unit.in_si);
        let of_sheet = self.sheet.and_then(|sheet| {
            let listed = sheet.listed();
            let value =
                listed.iter().find(|entry| entry.symbol == symbol && entry.direction == direction);
            value.map(|entry| entry.value)
        });
        let key = direction
            .map_or(symbol.to_owned(), |direction| format!("{}.{symbol}", direction.name()));
        let kept = self
            .fabric
            .provenance
            .as_ref()
            .and_then(|provenance| provenance.unused.get(&key).copied());
        of_sheet.or(kept).map(|value| value * unit)
    }
}

/// Returns whether a `sheet` determines the value `symbol`: directly, by other values or by a
/// curve. There is one law of shear.
fn is_known(sheet: &Sheet, direction: Direction, symbol: Symbol) -> bool {
    let tests = match symbol.test() {
        Test::Bending => &[Test::Bending, Test::LoopBending][..],
        Test::Shear => &[Test::Shear],
        _ => &[Test::Tensile],
    };
    let directions = if symbol.test() == Test::Shear { &DIRECTIONS[..] } else { &[direction] };
    // Only a curve that comes back determines the recovered work.
    let comes_back = |curve: &Curve| curve.branches().iter().any(|branch| !branch.rising);
    let has_curve = |curve: &Curve| {
        let is_of_law = tests.contains(&curve.test) && directions.contains(&curve.direction);
        is_of_law && (symbol != Symbol::Rt || comes_back(curve))
    };
    let has = |symbol: Symbol| {
        directions.iter().any(|direction| sheet.values(*direction).get(symbol).is_some())
    };
    // WT is LT times EM times half of the load, so two of these values determine the third.
    let others = match symbol {
        Symbol::Wt => [Symbol::Lt, Symbol::Em],
        Symbol::Lt => [Symbol::Wt, Symbol::Em],
        Symbol::Em => [Symbol::Wt, Symbol::Lt],
        symbol => [symbol; 2],
    };
    sheet.curves.iter().any(has_curve) || has(symbol) || others.into_iter().all(has)
}

/// Returns the sample standard deviation of `values`, `None` for fewer than two.
fn sample_deviation(values: &[f64]) -> Option<f64> {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (values.len() > 1).then(|| (squares / (count - 1.0)).sqrt())
}

/// Returns the page of `fabrics`: their measured curves and the loops of their laws overlaid, with
/// measured values and values of laws side by side.
#[must_use]
pub fn compare_page(fabrics: &[ComparedFabric<'_>]) -> ComparePage {
    let name = |compared: &ComparedFabric<'_>| FabricName {
        name: compared.fabric.name.clone(),
        source: compared.fabric.source.clone(),
    };

    let measured = MEASURED.into_iter().filter_map(|test| measured_overlay(fabrics, test));
    let loops = TESTS.into_iter().map(|test| law_overlay(fabrics, test));
    let alike = loads_are_alike(fabrics);

    let mut values = given_values(fabrics);
    for direction in DIRECTIONS {
        values.extend(Symbol::ALL.map(|symbol| ComparedValue {
            symbol: symbol.name().into(),
            name: kes_value::words(symbol).into(),
            direction: direction.name().into(),
            units: kes_value::units(symbol.name()),
            numbers: fabrics.iter().map(|compared| compared.number(direction, symbol)).collect(),
            is_comparable: alike || symbol.test() != Test::Tensile,
        }));
    }
    values.extend(other_values(fabrics));

    ComparePage {
        fabrics: fabrics.iter().map(name).collect(),
        version: VERSION.into(),
        overlays: measured.chain(loops).collect(),
        values,
        notes: load_note(fabrics, alike).into_iter().chain(assumptions(fabrics)).collect(),
        ..ComparePage::default()
    }
}

/// Returns the assumptions of `fabrics`. Each assumption appears once, with the names of its
/// fabrics.
fn assumptions(fabrics: &[ComparedFabric<'_>]) -> Vec<String> {
    let mut shared: Vec<(&str, Vec<&str>)> = Vec::new();
    for compared in fabrics {
        let assumed =
            compared.fabric.provenance.as_ref().map_or(&[][..], |provenance| &provenance.assumed);
        for text in assumed {
            match shared.iter_mut().find(|(known, _)| known == text) {
                Some((_, names)) => names.push(&compared.fabric.name),
                None => shared.push((text, vec![&compared.fabric.name])),
            }
        }
    }
    let all = fabrics.len();
    let line = |(text, names): (&str, Vec<&str>)| match names.len() {
        count if count == all && all > 1 => format!("all: {text}"),
        _ => format!("{}: {text}", names.join(", ")),
    };
    shared.into_iter().map(line).collect()
}

/// Returns an overlay of the measured curves of a `test`, `None` if no fabric has such a curve.
fn measured_overlay(fabrics: &[ComparedFabric<'_>], test: Test) -> Option<OverlayPlot> {
    let traces = |compared: &ComparedFabric<'_>| -> Vec<Trace> {
        let curves = compared.sheet.map_or(&[][..], |sheet| &sheet.curves);
        let of_test = curves.iter().filter(|curve| curve.test == test);
        of_test.map(|curve| trace(curve.direction.name(), curve)).collect()
    };
    let traces: Vec<Vec<Trace>> = fabrics.iter().map(traces).collect();
    let are_some = traces.iter().any(|traces| !traces.is_empty());
    are_some.then(|| overlay(fabrics, test, format!("{}, measured", test.name()), traces))
}

/// Returns an overlay of the loops of a `test` that an ideal instrument would draw.
fn law_overlay(fabrics: &[ComparedFabric<'_>], test: Test) -> OverlayPlot {
    let trace_of = |fabric: &Fabric, direction: Direction| {
        let label = if test == Test::Shear { "shear" } else { direction.name() };
        Some(trace(label, &loop_of(fabric, test, direction)?))
    };
    let traces = fabrics.iter().map(|compared| {
        let directions = directions(test).iter();
        directions.filter_map(|&direction| trace_of(compared.fabric, direction)).collect()
    });
    overlay(fabrics, test, format!("{}, laws", test.name()), traces.collect())
}

/// Returns an overlay of `traces` of a `test`.
fn overlay(
    fabrics: &[ComparedFabric<'_>],
    test: Test,
    title: String,
    traces: Vec<Vec<Trace>>,
) -> OverlayPlot {
    let [deformation, load] = quantity::axes(test);
    let fabrics = fabrics.iter().map(|compared| compared.fabric.name.clone()).collect();
    OverlayPlot { title, deformation, load, fabrics, traces }
}

/// Returns mass, thickness and surface friction of `fabrics`.
fn given_values(fabrics: &[ComparedFabric<'_>]) -> Vec<ComparedValue> {
    let value = |symbol: &str,
                 name: &str,
                 units: Units,
                 read: fn(&ComparedFabric<'_>) -> ComparedNumber| {
        ComparedValue {
            symbol: symbol.into(),
            name: name.into(),
            direction: String::new(),
            units,
            numbers: fabrics.iter().map(read).collect(),
            is_comparable: true,
        }
    };
    let mass = value("W", "mass per area", quantity::mass(), |compared| {
        SheetNumber::read(compared.sheet, Sheet::density).beside(compared.fabric.density)
    });
    let thickness = value("T", "thickness", quantity::thickness(), |compared| {
        SheetNumber::read(compared.sheet, Sheet::thickness).beside(compared.fabric.thickness)
    });
    let friction = value("µ", "surface friction", quantity::ratio(), |compared| {
        SheetNumber::read(compared.sheet, surface_friction).beside(compared.fabric.surface_friction)
    });
    vec![mass, thickness, friction]
}

/// Number of a fabric in the sheet of its measurements.
enum SheetNumber {
    /// The fabric has no sheet.
    NoSheet,
    /// The sheet does not have the number, and the law assumes one.
    Missing,
    /// The sheet has the number, in SI.
    Measured(f64),
}

impl SheetNumber {
    /// Returns the number that `read` finds in the `sheet` of a fabric.
    fn read(sheet: Option<&Sheet>, read: fn(&Sheet) -> Option<f64>) -> SheetNumber {
        match sheet.map(read) {
            None => SheetNumber::NoSheet,
            Some(None) => SheetNumber::Missing,
            Some(Some(number)) => SheetNumber::Measured(number),
        }
    }

    /// Returns the number beside the number of the `law`, in SI.
    fn beside(&self, law: f64) -> ComparedNumber {
        let (measured, is_assumed) = match *self {
            SheetNumber::NoSheet => (None, false),
            SheetNumber::Missing => (None, true),
            SheetNumber::Measured(number) => (Some(number), false),
        };
        ComparedNumber { measured, law: Some(law), is_assumed, ..ComparedNumber::default() }
    }
}

/// Returns the coefficient of friction of a `sheet`, the mean over its directions.
fn surface_friction(sheet: &Sheet) -> Option<f64> {
    let values: Vec<f64> = [sheet.warp.miu, sheet.weft.miu].into_iter().flatten().collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    sheet.miu.or((!values.is_empty()).then_some(mean))
}

/// Returns the values that no law has, if one of `fabrics` has them.
fn other_values(fabrics: &[ComparedFabric<'_>]) -> Vec<ComparedValue> {
    let both = DIRECTIONS.map(Some);
    let directions = |symbol: &str| match symbol {
        "MMD" | "SMD" => &both[..],
        _ => &[None][..],
    };
    let rows = OTHERS
        .iter()
        .flat_map(|symbol| directions(symbol).iter().map(move |direction| (symbol, *direction)));
    let value = |(symbol, direction): (&&str, Option<Direction>)| {
        let measured = |compared: &ComparedFabric<'_>| ComparedNumber {
            measured: compared.other(symbol, direction),
            ..ComparedNumber::default()
        };
        let numbers: Vec<ComparedNumber> = fabrics.iter().map(measured).collect();
        numbers.iter().any(|number| number.measured.is_some()).then(|| ComparedValue {
            symbol: (*symbol).into(),
            name: other_name(symbol).into(),
            direction: direction.map_or(String::new(), |direction| direction.name().into()),
            units: kes_value::units(symbol),
            numbers,
            is_comparable: true,
        })
    };
    rows.filter_map(value).collect()
}

/// Returns the name of the value `symbol` that no law has.
fn other_name(symbol: &str) -> &'static str {
    match symbol {
        "TM" => "thickness at 50 gf/cm²",
        "LC" => "compression linearity",
        "WC" => "compression work",
        "RC" => "compression resilience",
        "MMD" => "deviation of the friction",
        _ => "surface roughness",
    }
}

/// Returns whether the tensile tests of all `fabrics` went to one load.
fn loads_are_alike(fabrics: &[ComparedFabric<'_>]) -> bool {
    let loads = fabrics.iter().map(|compared| compared.points().maximum_tension);
    let (least, most) = loads.fold((f64::MAX, 0.0_f64), |(a, b), load| (a.min(load), b.max(load)));
    most <= least * (1.0 + SAME_LOAD)
}

/// Returns the reason why tensile values have no differences. Returns `None` if the loads
/// `are_alike`.
fn load_note(fabrics: &[ComparedFabric<'_>], are_alike: bool) -> Option<String> {
    let load = |compared: &ComparedFabric<'_>| {
        format!("{} {:.1} N/m", compared.fabric.name, compared.points().maximum_tension)
    };
    let loads = fabrics.iter().map(load).collect::<Vec<_>>().join(", ");
    (!are_alike)
        .then(|| format!("LT, WT, RT and EM are of different loads, and not compared: {loads}"))
}
