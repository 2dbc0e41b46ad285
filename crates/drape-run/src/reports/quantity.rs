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

pub fn ratio() -> Units {
    Units::si("")
}

pub fn percent() -> Units {
    Units::si("").with_kes("%", 0.01)
}

pub fn tension() -> Units {
    Units::si("N/m").with_kes("gf/cm", 1e2 * GRAM_FORCE)
}

pub fn moment() -> Units {
    Units::si("N").with_kes("gf·cm/cm", GRAM_FORCE)
}

pub fn rigidity() -> Units {
    Units::si("N·m").with_kes("gf·cm²/cm", 1e-2 * GRAM_FORCE)
}

pub fn curvature() -> Units {
    Units::si("1/m").with_kes("1/cm", 1e2)
}

pub fn shear_stiffness() -> Units {
    Units::si("N/(m·rad)").with_kes("gf/(cm·deg)", 1e2 * GRAM_FORCE / DEGREE)
}

pub fn work() -> Units {
    Units::si("J/m²").with_kes("gf·cm/cm²", 1e2 * GRAM_FORCE)
}

pub fn mass() -> Units {
    Units::si("kg/m²").with_kes("mg/cm²", 1e-2)
}

pub fn thickness() -> Units {
    Units::si("m").with_kes("mm", 1e-3)
}

/// Axes of a test's plots: deformation, then load.
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

/// Axes of a test's plots in the units of the laboratory: deformation, then load.
pub fn laboratory_axes(test: Test) -> [Axis; 2] {
    let [deformation, load] = axes(test);
    let units = self::load(test).kes.map(|unit| Axis::new(&load.label, &unit.name, unit.in_si));
    [deformation, units.unwrap_or(load)]
}

/// Units of the load of a test.
fn load(test: Test) -> Units {
    if test == Test::Bending { moment() } else { tension() }
}

/// Units of the stiffness of a test's law.
fn stiffness_of(test: Test) -> Units {
    match test {
        Test::Tensile => tension(),
        Test::Shear => shear_stiffness(),
        Test::Bending | Test::LoopBending => rigidity(),
    }
}

/// Describes a parameter of a test's law by its name in the fit; an unknown name stands for itself.
pub fn parameter(test: Test, name: &'static str) -> Quantity {
    let incidental = matches!(name, "zero" | "free strain" | "drift" | "state");
    let of = |symbol, words, units| Quantity { symbol, words, units, incidental };
    let bends = matches!(test, Test::Bending | Test::LoopBending);
    let friction = if bends { moment() } else { tension() };
    let length = match test {
        Test::Tensile => percent(),
        Test::Shear => ratio(),
        Test::Bending | Test::LoopBending => curvature(),
    };
    match name {
        "stiffness" if test == Test::Shear => of("k_s", "shear stiffness", shear_stiffness()),
        "stiffness" => of("k_t", "tensile stiffness", tension()),
        "rigidity" => of("k_b", "bending rigidity", rigidity()),
        "toe_ratio" => of("r_1", "toe ratio, F₁/(k ε₁)", ratio()),
        "toe_strain" => of("ε_1", "end of the toe, virgin", percent()),
        "toe_growth" => of("ε_1'", "end of the toe once stretched, over the virgin one", ratio()),
        "toe_stiffness" => of("k_e", "stiffness that the toe adds at its end", tension()),
        "steepness" => of("b", "logarithm of the growth of that stiffness over the toe", ratio()),
        "toe_end" => of("ε_c", "end of the toe, virgin", percent()),
        "base_stiffness" => of("k_0", "stiffness at every strain", tension()),
        "friction_ratio" => of("μ", "friction over elastic load", ratio()),
        "friction_length" => of("x_f", "friction length", length),
        "friction_plateau" => of("c", "friction of yarns without tension", tension()),
        "initial_stiffness" => of("k_i", "stiffness at rest", stiffness_of(test)),
        "final_stiffness" => of("k_f", "stiffness far from rest", stiffness_of(test)),
        "transition" => of("q_t", "where the stiffness changes", length),
        "quadratic" => of("a_2", "coefficient of ε²", tension()),
        "quartic" => of("a_4", "coefficient of ε⁴", tension()),
        "plateau" => of("F_c", "friction plateau", friction),
        "length" => of("x_f", "friction length", length),
        "second plateau" => of("F_2", "plateau of the second element", friction),
        "second length" => of("x_2", "length of the second element", length),
        "slow" => of("F_2", "plateau of the second element, over the first", ratio()),
        "ratio" => of("η", "friction length of the fast element over the slow", ratio()),
        "growth" => of("g", "growth of the plateau with the sine of the angle", ratio()),
        "slope" => of("k_B", "slope of the line", if bends { rigidity() } else { tension() }),
        "intercept" => of("M_0", "the line at zero", load(test)),
        "knot" => of("q_1", "where the line begins", length),
        "zero" => of("F_0", "zero of the load", load(test)),
        "free strain" => of("ε_0", "strain at which the strip becomes taut", percent()),
        "drift" => of("F_d", "drift of the zero over the test", load(test)),
        "state" => of("s_0", "friction at the start, over the plateau", ratio()),
        _ => of(name, name, Units::si("SI")),
    }
}
