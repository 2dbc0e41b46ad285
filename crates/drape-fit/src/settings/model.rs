//! Laws that a curve can be fitted with.

/// Friction elements of a bending or shear law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FrictionOrder {
    /// One element, whose load approaches one plateau.
    #[default]
    First,
    /// Two positive elements of different length in parallel: nested loops that grow with their
    /// amplitude.
    Parallel,
    /// Fast element less a slow one: stiction, and a drop to the plateau \[BS95\].
    Second,
}

impl FrictionOrder {
    /// All orders, in the order of preference.
    pub const ALL: [Self; 3] = [Self::First, Self::Parallel, Self::Second];

    /// Returns the name in reports, such as `"one friction element"`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::First => "one friction element",
            Self::Parallel => "two friction elements side by side",
            Self::Second => "friction of second order",
        }
    }
}

/// Whether the plateau of a shear friction grows with the angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Plateau {
    /// Same plateau at all angles \[NB04, eq. 5\].
    Constant,
    /// Plateau that grows with the sine of the angle, because KES loops widen (2HG5 > 2HG).
    #[default]
    Growing,
}

/// Law that a bending or a shear loop is fitted with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopModel {
    /// Linear backbone with friction, fitted to the whole history \[NB04, eqs. 4–5\].
    Linear(FrictionOrder),
    /// Stiffness that changes along the test, with one friction element, fitted to the whole
    /// history.
    Varying,
    /// Parabola that continues as a straight line, without friction, fitted to the first loading
    /// branch \[BHW94, §5.1\].
    Piecewise,
}

impl Default for LoopModel {
    /// Returns [`LoopModel::Linear`] with one friction element.
    fn default() -> Self {
        Self::Linear(FrictionOrder::First)
    }
}

/// Traction law that a tensile curve is fitted with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TractionModel {
    /// Exponential toe that continues as its tangent, with friction that grows with the tension.
    #[default]
    Exponential,
    /// Priming zone that continues as a straight line, with friction \[NB04, eq. 3\].
    Primed,
    /// Even polynomial, with friction \[THK03, fig. 8a\].
    Polynomial,
}

/// Whether the toe, or the priming zone, becomes longer once the fabric has been stretched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Toe {
    /// Toe of constant length.
    ///
    /// Of the two this predicts the next, larger cycle better: on strips of cupro its peak by 4 to
    /// 13 % too low, with a moving toe by 1 to 19 %.
    #[default]
    Still,
    /// Toe whose end moves with the largest elongation \[NB04, table 1\].
    Moving,
}
