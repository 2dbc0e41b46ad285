//! One fabric from one sheet.

use std::collections::BTreeMap;

use drape_fabric::{self as fabric, Fabric, Provenance, SURFACE_FRICTION};
use drape_kes::{BendingValues, Direction, Sheet};

use crate::error::Error;
use crate::fabric::laws::SheetLaws;
use crate::fabric::measured_range::measured_range;
use crate::fabric::{keys, scatter};
use crate::regression::curve_fit::CurveFit;
use crate::settings::FitSettings;
use crate::values::assumed;
use crate::values::bending::bending_from_values;
use crate::values::matched::Noted;

/// Identified fabric, with the fits and assumptions that it comes from.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Fit {
    /// Identified fabric.
    pub fabric: Fabric,
    /// Fit of each of the sheet's curves, in the order of the sheet.
    pub curves: Vec<CurveFit>,
    /// Notes on what the sheet does not have and what was taken in its place.
    pub assumed: Vec<String>,
}

/// Identifies a fabric from `sheet`, with the default settings.
///
/// ```
/// use drape_fit::identify;
/// use drape_kes::{Sheet, Values};
///
/// let mut sheet = Sheet::default();
/// sheet.name = "shirting".into();
/// sheet.w = Some(12.0);
/// sheet.warp = Values { b: Some(0.09), em: Some(4.5), rt: Some(62.0), ..Values::default() };
///
/// let fit = identify(&sheet)?;
/// assert!((fit.fabric.density - 0.12).abs() < 1e-12);
/// assert!(fit.assumed.iter().any(|note| note == "weft bending: not measured, the warp's taken"));
/// # Ok::<(), drape_fit::Error>(())
/// ```
///
/// # Errors
/// A curve or a set of values gives no law, or the fabric is impossible.
pub fn identify(sheet: &Sheet) -> Result<Fit, Error> {
    identify_with(sheet, &FitSettings::default())
}

/// Identifies a fabric from `sheet`, with the given `settings`.
///
/// Curves come before values, values before defaults, and each default is named. Of several curves
/// of one test and direction the first gives the law, except that loop-bending curves give one law
/// together. A law that is missing in one direction is taken from the other direction.
///
/// # Errors
/// A curve or a set of values gives no law, or the fabric is impossible.
pub fn identify_with(sheet: &Sheet, settings: &FitSettings) -> Result<Fit, Error> {
    let settings = &settings.with_default_model(sheet.model);
    let laws = SheetLaws::new(sheet, settings)?;
    let mut notes = Vec::new();

    let density = sheet.density().unwrap_or_else(|| {
        notes.push(format!("density: not measured, {} kg/m² taken", assumed::DENSITY));
        assumed::DENSITY
    });
    let thickness = sheet.thickness().unwrap_or_else(|| {
        notes.push(format!("thickness: not measured, {} m taken", assumed::THICKNESS));
        assumed::THICKNESS
    });

    let pressed_thickness = sheet.pressed_thickness();
    if pressed_thickness.is_none() {
        notes.push("pressed_thickness: not measured, 0.7 of the thickness taken".into());
    } else if sheet.tm.is_none() {
        notes.push("pressed_thickness: not measured, that of LC and WC taken".into());
    }
    // The linearity has no meaning without both thicknesses.
    let measured = sheet.thickness().is_some() && pressed_thickness.is_some();
    let compression_linearity = sheet.compression_linearity().filter(|_| measured);
    if let Some(linearity) = compression_linearity.filter(|_| sheet.lc.is_none()) {
        notes.push(format!(
            "compression_linearity: not measured, {linearity:.3} by WC, T0 and TM taken"
        ));
    }

    let shared: Vec<&str> =
        sheet.shared.iter().copied().filter(|key| !SURFACE.contains(key)).collect();
    if !shared.is_empty() {
        notes.push(format!("{}: one value, for both directions", shared.join(", ")));
    }
    let surface_friction = sheet.miu.unwrap_or_else(|| {
        notes.push(format!("surface_friction: not measured, {SURFACE_FRICTION} taken"));
        SURFACE_FRICTION
    });

    // A direction without a law takes the law of the other direction.
    let [warp, weft] = [Direction::Warp, Direction::Weft].map(|direction| laws.traction(direction));
    let traction =
        laws_of_both("traction", [warp?, weft?], &mut notes, |notes| laws.assumed_traction(notes))?;
    let [warp, weft] =
        [Direction::Warp, Direction::Weft].map(|direction| laws.bending(direction, density));
    let bending = laws_of_both("bending", [warp, weft], &mut notes, |notes| {
        let rigidity = assumed::bending_rigidity(density);
        let law = bending_from_values(&BendingValues { rigidity, loop_width: 0.0 });
        notes
            .push("bending: not measured, a bending length of 20 mm without friction taken".into());
        Ok(law)
    })?;
    let shear = laws.shear(&mut notes);
    notes.push("traction in compression: not measured, buckling at 0.2 % taken".into());
    if let Some(locking) = shear.locking {
        let degrees = locking.onset.asin().to_degrees();
        notes.push(format!("shear beyond {degrees:.1}°: not measured, jamming before 60° taken"));
    }

    // Standard errors come from the curves, and from the standard deviations of the values.
    let fits = laws.into_fits();
    let mut errors = keys::fitted_errors(&fits);
    let errors_of_values = scatter::fitted_errors(sheet, &keys::laws(&fits), |sheet: &Sheet| {
        identify_with(sheet, settings).ok().map(|fit| fit.fabric)
    });
    match errors_of_values {
        Some(of_values) => errors.extend(of_values),
        None => notes.push(
            "standard deviations of the values: not used, since values close by give laws of another \
             form"
                .into(),
        ),
    }

    let fabric = Fabric {
        name: sheet.name.clone(),
        source: sheet.source.trim().to_owned(),
        density,
        thickness,
        pressed_thickness,
        compression_linearity,
        surface_friction,
        warp: fabric::YarnLaws { traction: traction.warp, bending: bending.warp },
        weft: fabric::YarnLaws { traction: traction.weft, bending: bending.weft },
        shear,
        provenance: Some(Provenance {
            sheet: sheet.name.clone(),
            digest: sheet.digest(),
            fitted_by: concat!("drape-fit ", env!("CARGO_PKG_VERSION")).to_owned(),
            assumed: notes.clone(),
            standard_errors: errors.standard,
            correlations: errors.correlations,
            unused: unused_values(sheet),
            measured_range: measured_range(sheet),
        }),
    };
    if let Some(problem) = fabric.problems().into_iter().next() {
        let fabric::Problem { key, message, help, .. } = problem;
        return Err(Error::InvalidFabric { key, message, help });
    }
    Ok(Fit { fabric, curves: fits, assumed: notes })
}

/// Symbols of the surface test, which usually have no direction.
const SURFACE: [&str; 3] = ["MIU", "MMD", "SMD"];

/// Returns the values of `sheet` that no part of the model uses, by their symbols.
///
/// A value whose test has a curve is not listed, because the curve is in the fabric.
fn unused_values(sheet: &Sheet) -> BTreeMap<String, f64> {
    sheet
        .listed()
        .into_iter()
        .filter(|value| ["RC", "MMD", "SMD"].contains(&value.symbol))
        .map(|value| {
            let key = match value.direction {
                Some(direction) => format!("{}.{}", direction.name(), value.symbol),
                None => value.symbol.to_owned(),
            };
            (key, value.value)
        })
        .collect()
}

/// Laws of one kind in both directions.
struct BothLaws<L> {
    warp: L,
    weft: L,
}

/// Returns the laws of both directions. A missing law is replaced by the law of the other
/// direction, and two missing laws by the law that `assume` returns.
fn laws_of_both<L: Copy>(
    kind: &str,
    [warp, weft]: [Option<Noted<L>>; 2],
    notes: &mut Vec<String>,
    assume: impl FnOnce(&mut Vec<String>) -> Result<L, Error>,
) -> Result<BothLaws<L>, Error> {
    let [warp, weft] = [warp, weft].map(|noted| {
        noted.map(|noted| {
            notes.extend(noted.notes);
            noted.law
        })
    });
    match (warp, weft) {
        (Some(warp), Some(weft)) => Ok(BothLaws { warp, weft }),
        (Some(warp), None) => {
            notes.push(format!("weft {kind}: not measured, the warp's taken"));
            Ok(BothLaws { warp, weft: warp })
        }
        (None, Some(weft)) => {
            notes.push(format!("warp {kind}: not measured, the weft's taken"));
            Ok(BothLaws { warp: weft, weft })
        }
        (None, None) => {
            let law = assume(notes)?;
            Ok(BothLaws { warp: law, weft: law })
        }
    }
}
