/// The elements of the friction of a bending or shear law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FrictionOrder {
    /// One element: loops whose friction settles to one plateau.
    #[default]
    First,
    /// Two positive elements of different length side by side: nested loops that grow with their amplitude.
    Parallel,
    /// A fast element less a slow one: stiction and a drop to the plateau [Bliman & Sorine 1995].
    Second,
}

impl FrictionOrder {
    /// All of them, in the order in which they are preferred.
    pub const ALL: [Self; 3] = [Self::First, Self::Parallel, Self::Second];

    /// In words.
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
    /// It is the same at all angles [Ngo Ngoc & Boivin 2004, eq. 5].
    Constant,
    /// It grows with the sine of the angle, because KES loops widen (2HG5 > 2HG).
    #[default]
    Growing,
}

/// Which law a bending or a shear loop is fitted with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopModel {
    /// A line with friction, along the whole history [Ngo Ngoc & Boivin 2004, eqs. 4–5].
    Linear(FrictionOrder),
    /// A quadratic and a line without friction, on the first loading branch
    /// [Breen, House & Wozny 1994, §5.1].
    Piecewise,
}

impl Default for LoopModel {
    fn default() -> Self {
        Self::Linear(FrictionOrder::First)
    }
}
