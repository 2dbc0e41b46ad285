/// Which law a sheet asks its bending and shear loops to be fitted with, instead of the one that they bear out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Model {
    /// A line with one friction element.
    FirstOrder,
    /// A line with two friction elements side by side.
    TwoElements,
    /// A line with a fast friction element less a slow one.
    SecondOrder,
    /// A quadratic and a line without friction, on the first branch [Breen, House & Wozny 1994].
    Breen1994,
}

impl Model {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::FirstOrder, Self::TwoElements, Self::SecondOrder, Self::Breen1994];

    /// The word for it in a sheet.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::FirstOrder => "first-order",
            Self::TwoElements => "two-elements",
            Self::SecondOrder => "second-order",
            Self::Breen1994 => "breen-1994",
        }
    }
}
