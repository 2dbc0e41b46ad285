//! Law that a sheet asks for.

/// Law that the bending and shear loops of a sheet are to be fitted with. Without a law the data
/// select one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Model {
    /// Linear backbone with one friction element.
    FirstOrder,
    /// Linear backbone with two friction elements in parallel.
    TwoElements,
    /// Linear backbone with a fast friction element less a slow one \[BS95\].
    SecondOrder,
    /// Backbone whose stiffness changes along the test, with one friction element.
    Varying,
    /// Parabola that continues as a straight line, without friction, on the first branch \[BHW94\].
    Breen1994,
}

impl Model {
    /// All models.
    pub const ALL: [Self; 5] =
        [Self::FirstOrder, Self::TwoElements, Self::SecondOrder, Self::Varying, Self::Breen1994];

    /// Returns the name in sheets, such as `"first-order"`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::FirstOrder => "first-order",
            Self::TwoElements => "two-elements",
            Self::SecondOrder => "second-order",
            Self::Varying => "varying",
            Self::Breen1994 => "breen-1994",
        }
    }
}
