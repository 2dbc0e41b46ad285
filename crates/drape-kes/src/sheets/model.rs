//! Law that a sheet asks for, and the names of the laws of loops.
//!
//! Sheets, the command line, Python and reports take the names from here, so that one law has one
//! name everywhere.

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
    Piecewise,
}

impl Model {
    /// All models.
    pub const ALL: [Self; 5] =
        [Self::FirstOrder, Self::TwoElements, Self::SecondOrder, Self::Varying, Self::Piecewise];

    /// Former names, each with the law that it named. [`Model::named`] accepts them.
    ///
    /// `"breen-1994"` is the name of a particle model in a scene, which is something else.
    pub const FORMER_NAMES: [(&'static str, Self); 2] =
        [("parallel", Self::TwoElements), ("breen-1994", Self::Piecewise)];

    /// Returns the name of the law, such as `"first-order"`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::FirstOrder => "first-order",
            Self::TwoElements => "two-elements",
            Self::SecondOrder => "second-order",
            Self::Varying => "varying",
            Self::Piecewise => "piecewise",
        }
    }

    /// Returns what the law is, in a few words for help texts and reports.
    #[must_use]
    pub const fn description(self) -> &'static str {
        match self {
            Self::FirstOrder => "a line with one friction element",
            Self::TwoElements => "a line with two friction elements in parallel, for nested loops",
            Self::SecondOrder => "a line with friction of second order (Bliman & Sorine 1995)",
            Self::Varying => "a stiffness that changes along the test, with one friction element",
            Self::Piecewise => "a quadratic and a line without friction (Breen et al. 1994)",
        }
    }

    /// Returns the law with the name or former name `word`.
    ///
    /// ```
    /// use drape_kes::Model;
    ///
    /// assert_eq!(Model::named("two-elements"), Some(Model::TwoElements));
    /// assert_eq!(Model::named("parallel"), Some(Model::TwoElements));
    /// assert_eq!(Model::named("third-order"), None);
    /// ```
    #[must_use]
    pub fn named(word: &str) -> Option<Self> {
        let current = Self::ALL.into_iter().find(|law| law.name() == word);
        current.or_else(|| {
            let former = Self::FORMER_NAMES.into_iter().find(|(name, _)| *name == word);
            former.map(|(_, law)| law)
        })
    }

    /// Returns the note on `word` if `word` is a former name of a law.
    ///
    /// ```
    /// use drape_kes::Model;
    ///
    /// let note = Model::note_on("parallel");
    /// assert_eq!(note.as_deref(), Some("`parallel` is now called `two-elements`"));
    /// assert_eq!(Model::note_on("two-elements"), None);
    /// ```
    #[must_use]
    pub fn note_on(word: &str) -> Option<String> {
        let (former, law) = Self::FORMER_NAMES.into_iter().find(|(name, _)| *name == word)?;
        Some(format!("`{former}` is now called `{}`", law.name()))
    }
}
