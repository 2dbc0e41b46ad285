//! Values of a compression curve (KES-FB3): T0, TM, LC, WC and RC from thickness and pressure.
//!
//! ```math
//! WC = \int_{T_m}^{T_0} P\,dT, \qquad LC = \frac{2\,WC}{P_m (T_0 - T_m)}, \qquad
//! RC = 100\,\frac{\int P\,dT\,\text{(recovery)}}{WC}
//! ```

use drape_input::{Quantity, parse_unit};

use crate::tables::block::Block;
use crate::tables::heading::normal;
use crate::tables::layout::Layout;
use crate::tables::number::Decimal;
use crate::tables::series::Series;

/// Pressure at which the thickness is T0, in Pa: 0.5 gf/cm².
const FIRST_PRESSURE: f64 = 49.033_25;
/// Pressure at which the thickness is TM, in Pa: 50 gf/cm².
const LARGEST_PRESSURE: f64 = 4_903.325;
/// Part by which the largest pressure may differ from the pressure of the test.
const PRESSURE_ALLOWED: f64 = 0.05;

const THICKNESS: [&str; 7] =
    ["thickness", "dicke", "épaisseur", "spessore", "espesor", "厚さ", "厚み"];
const PRESSURE: [&str; 9] =
    ["pressure", "druck", "pression", "pressione", "presión", "圧力", "荷重", "force", "load"];

/// Values of a compression curve, in the laboratory's units: mm, gf·cm/cm², percent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Compression {
    pub(crate) t0: f64,
    pub(crate) tm: f64,
    pub(crate) lc: f64,
    pub(crate) wc: f64,
    pub(crate) rc: Option<f64>,
}

/// Point of the curve: thickness in m, pressure in Pa.
#[derive(Clone, Copy)]
struct Point {
    thickness: f64,
    pressure: f64,
}

/// Returns the columns of thickness and pressure of `block`, if both are there with their units.
pub(crate) fn columns(block: &Block) -> Option<[usize; 2]> {
    Some([
        column_with(block, &THICKNESS, Quantity::Length)?,
        column_with(block, &PRESSURE, Quantity::Pressure)?,
    ])
}

/// Returns the column of `block` whose heading has one of `words` and a unit of `quantity`.
fn column_with(block: &Block, words: &[&str], quantity: Quantity) -> Option<usize> {
    block.number_columns().into_iter().find(|&column| {
        let Some(heading) = block.headings.get(column) else { return false };
        let unit = heading.unit.as_deref();
        let fits = unit.is_some_and(|unit| parse_unit(unit, &[quantity]).is_ok());
        fits && words.iter().any(|word| normal(&heading.name).contains(word))
    })
}

/// Returns the values of the compression curve in the `columns` of `series`. `Err` holds the reason
/// why a value is missing.
pub(crate) fn values(series: &Series, columns: [usize; 2]) -> Result<Compression, String> {
    let decimal = crate::tables::find::decimal_sign(series, &Layout::default());
    let decimal = decimal.map_err(|_| "its decimal sign cannot be told".to_owned())?;
    let points = read_points(&series.block, columns, decimal)?;

    // The curve must end at the pressure of TM.
    let top = (0..points.len()).max_by(|&a, &b| points[a].pressure.total_cmp(&points[b].pressure));
    let top = top.ok_or("it has no rows")?;
    let largest = points[top].pressure;
    if (largest / LARGEST_PRESSURE - 1.0).abs() > PRESSURE_ALLOWED {
        return Err(format!(
            "it reaches {largest:.0} Pa, and TM is the thickness at 4903 Pa (50 gf/cm2)"
        ));
    }

    // T0 is the thickness at the pressure where the test begins.
    let (loading, recovery) = (&points[..=top], &points[top..]);
    let start = crossing(loading, FIRST_PRESSURE)
        .ok_or("it does not begin below 49 Pa (0.5 gf/cm2), where T0 is measured")?;
    let (t0, tm) = (start.thickness, points[top].thickness);
    let mut pressed = vec![start];
    pressed.extend(loading.iter().copied().skip_while(|point| point.pressure <= FIRST_PRESSURE));
    let wc = work(&pressed);
    if !(t0 > tm && tm > 0.0 && wc > 0.0) {
        return Err("its thickness does not fall from T0 to TM".to_owned());
    }

    let rc = (recovery.len() > 2).then(|| {
        // The recovery ends at the pressure of T0, or at the end of the file.
        let end = recovery.iter().position(|point| point.pressure < FIRST_PRESSURE);
        -100.0 * work(&recovery[..end.unwrap_or(recovery.len())]) / wc
    });
    let gram = Quantity::WorkPerArea.laboratory().factor;
    let lc = 2.0 * wc / (largest * (t0 - tm));
    Ok(Compression { t0: 1e3 * t0, tm: 1e3 * tm, lc, wc: wc / gram, rc })
}

/// Reads the points in the `columns` of `block`, in SI.
fn read_points(block: &Block, columns: [usize; 2], decimal: Decimal) -> Result<Vec<Point>, String> {
    let mut factors = [1.0; 2];
    for (axis, quantity) in [Quantity::Length, Quantity::Pressure].into_iter().enumerate() {
        let unit = block.headings[columns[axis]].unit.as_deref().unwrap_or_default();
        factors[axis] = parse_unit(unit, &[quantity]).map_or(1.0, |unit| unit.factor);
    }
    let mut points = Vec::with_capacity(block.rows.len());
    for row in &block.rows {
        let [thickness, pressure] = [0, 1].map(|axis| {
            let cell = row.cells.get(columns[axis]);
            let number = cell.and_then(|cell| cell.number(decimal));
            number.filter(|number| number.is_finite()).map(|number| number * factors[axis])
        });
        let (Some(thickness), Some(pressure)) = (thickness, pressure) else {
            return Err(format!("line {} has no thickness or no pressure", row.line));
        };
        points.push(Point { thickness, pressure });
    }
    Ok(points)
}

/// Returns the first point at `pressure`, interpolated between `points`.
fn crossing(points: &[Point], pressure: f64) -> Option<Point> {
    points.windows(2).find(|pair| pair[0].pressure <= pressure && pair[1].pressure > pressure).map(
        |pair| {
            let part = (pressure - pair[0].pressure) / (pair[1].pressure - pair[0].pressure);
            let thickness = pair[0].thickness + part * (pair[1].thickness - pair[0].thickness);
            Point { thickness, pressure }
        },
    )
}

/// Returns the work along `points`, positive where the thickness falls, in J/m².
fn work(points: &[Point]) -> f64 {
    points
        .windows(2)
        .map(|pair| {
            0.5 * (pair[0].pressure + pair[1].pressure) * (pair[0].thickness - pair[1].thickness)
        })
        .sum()
}
