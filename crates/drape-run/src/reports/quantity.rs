//! Names, symbols and units of the numbers of a test, and the axes of its plots.

use drape_kes::{Direction, Test};
use drape_report::Units;
use drape_report::plot::Axis;

/// Directions of the yarns, in the order of the pages.
pub const DIRECTIONS: [Direction; 2] = [Direction::Warp, Direction::Weft];

/// One gram-force, in N.
const GRAM_FORCE: f64 = 9.806_65e-3;
/// One degree, in rad.
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Parameter of the law of a test, as a page shows it.
pub struct Quantity {
    pub symbol: &'static str,
    /// Name in words.
    pub words: &'static str,
    pub units: Units,
    /// Whether it is a property of the test, not of the fabric.
    pub incidental: bool,
}

/// Returns the units of a ratio.
pub fn ratio() -> Units {
    Units::si("")
}

/// Returns the units of a ratio that is shown in per cent.
pub fn percent() -> Units {
    Units::si("").with_kes("%", 0.01)
}

/// Returns the units of a force per width.
pub fn tension() -> Units {
    Units::si("N/m").with_kes("gf/cm", 1e2 * GRAM_FORCE)
}

/// Returns the units of a bending moment per width.
pub fn moment() -> Units {
    Units::si("N").with_kes("gf·cm/cm", GRAM_FORCE)
}

/// Returns the units of a bending rigidity per width.
pub fn rigidity() -> Units {
    Units::si("N·m").with_kes("gf·cm²/cm", 1e-2 * GRAM_FORCE)
}

/// Returns the units of a curvature.
pub fn curvature() -> Units {
    Units::si("1/m").with_kes("1/cm", 1e2)
}

/// Returns the units of a shear stiffness.
pub fn shear_stiffness() -> Units {
    Units::si("N/(m·rad)").with_kes("gf/(cm·deg)", 1e2 * GRAM_FORCE / DEGREE)
}

/// Returns the units of a work per area.
pub fn work() -> Units {
    Units::si("J/m²").with_kes("gf·cm/cm²", 1e2 * GRAM_FORCE)
}

/// Returns the units of a mass per area.
pub fn mass() -> Units {
    Units::si("kg/m²").with_kes("mg/cm²", 1e-2)
}

/// Returns the units of a thickness.
pub fn thickness() -> Units {
    Units::si("m").with_kes("mm", 1e-3)
}

/// Returns the axes of the plots of a `test`: deformation, then load.
pub fn axes(test: Test) -> [Axis; 2] {
    match test {
        Test::Tensile => [Axis::new("strain", "%", 0.01), Axis::new("tension", "N/m", 1.0)],
        Test::Shear => [Axis::new("angle", "°", DEGREE), Axis::new("shear force", "N/m", 1.0)],
        Test::Bending => [Axis::new("curvature", "1/cm", 1e2), Axis::new("moment", "mN", 1e-3)],
        Test::LoopBending => {
            [Axis::new("approach of the clamps", "%", 0.01), Axis::new("force", "N/m", 1.0)]
        }
    }
}

/// Returns the axes of the plots of a `test` in the units of the laboratory: deformation, then
/// load.
pub fn laboratory_axes(test: Test) -> [Axis; 2] {
    let [deformation, load] = axes(test);
    let units = self::load(test).kes.map(|unit| Axis::new(&load.label, &unit.name, unit.in_si));
    [deformation, units.unwrap_or(load)]
}

/// Returns the units of the load of a `test`.
fn load(test: Test) -> Units {
    if test == Test::Bending { moment() } else { tension() }
}

/// Returns the units of the stiffness of the law of a `test`.
fn stiffness_of(test: Test) -> Units {
    match test {
        Test::Tensile => tension(),
        Test::Shear => shear_stiffness(),
        Test::Bending | Test::LoopBending => rigidity(),
    }
}

/// Returns the description of the parameter `name` of the law of a `test`. An unknown name stands
/// for itself.
pub fn parameter(test: Test, name: &'static str) -> Quantity {
    let incidental = matches!(name, "zero" | "free strain" | "drift" | "state");
    let named = |symbol, words, units| Quantity { symbol, words, units, incidental };
    let bends = matches!(test, Test::Bending | Test::LoopBending);
    let friction = if bends { moment() } else { tension() };
    let length = match test {
        Test::Tensile => percent(),
        Test::Shear => ratio(),
        Test::Bending | Test::LoopBending => curvature(),
    };

    match name {
        "stiffness" if test == Test::Shear => named("k_s", "shear stiffness", shear_stiffness()),
        "stiffness" => named("k_t", "tensile stiffness", tension()),
        "rigidity" => named("k_b", "bending rigidity", rigidity()),
        "toe_ratio" => named("r_1", "toe ratio, F₁/(k ε₁)", ratio()),
        "toe_strain" => named("ε_1", "end of the toe, virgin", percent()),
        "toe_growth" => {
            named("ε_1'", "end of the toe once stretched, over the virgin one", ratio())
        }
        "toe_stiffness" => named("k_e", "stiffness that the toe adds at its end", tension()),
        "steepness" => {
            named("b", "logarithm of the growth of that stiffness over the toe", ratio())
        }
        "toe_end" => named("ε_c", "end of the toe, virgin", percent()),
        "base_stiffness" => named("k_0", "stiffness at every strain", tension()),
        "friction_ratio" => named("μ", "friction over elastic load", ratio()),
        "friction_length" => named("x_f", "friction length", length),
        "friction_plateau" => named("c", "friction of yarns without tension", tension()),
        "initial_stiffness" => named("k_i", "stiffness at rest", stiffness_of(test)),
        "final_stiffness" => named("k_f", "stiffness far from rest", stiffness_of(test)),
        "transition" => named("q_t", "where the stiffness changes", length),
        "quadratic" => named("a_2", "coefficient of ε²", tension()),
        "quartic" => named("a_4", "coefficient of ε⁴", tension()),
        "plateau" => named("F_c", "friction plateau", friction),
        "length" => named("x_f", "friction length", length),
        "second plateau" => named("F_2", "plateau of the second element", friction),
        "second length" => named("x_2", "length of the second element", length),
        "slow" => named("F_2", "plateau of the second element, over the first", ratio()),
        "ratio" => named("η", "friction length of the fast element over the slow", ratio()),
        "growth" => named("g", "growth of the plateau with the sine of the angle", ratio()),
        "slope" => named("k_B", "slope of the line", if bends { rigidity() } else { tension() }),
        "intercept" => named("M_0", "the line at zero", load(test)),
        "knot" => named("q_1", "where the line begins", length),
        "zero" => named("F_0", "zero of the load", load(test)),
        "free strain" => named("ε_0", "strain at which the strip becomes taut", percent()),
        "drift" => named("F_d", "drift of the zero over the test", load(test)),
        "state" => named("s_0", "friction at the start, over the plateau", ratio()),
        _ => named(name, name, Units::si("SI")),
    }
}
