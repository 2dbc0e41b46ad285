//! Text of a cell beside numbers, split into item, unit, direction, specimen, statistic, face and
//! name.

pub(crate) mod letters;
mod names;
mod tags;
pub(crate) mod written_unit;

pub(crate) use self::tags::{Cut, Face, HeadKind, Statistic};

use drape_input::{Quantity, parse_unit};

use crate::results::item::{Item, WrittenSymbol};
use crate::results::label::letters::{half_width, numbers, take_words};
use crate::results::label::names::{
    BACK, COUNT, DEVIATION, ERROR, FABRIC, FACE, GENERIC, ITEMS, MEAN, OTHER, OTHER_TESTS, SAMPLE,
    SPECIMEN, UNIT, VARIATION,
};
use crate::results::label::written_unit::{WrittenUnit, find_bracket, split_unit};
use crate::sheets::spelling;
use crate::tables::heading::words::{BIAS, single};
use crate::tables::heading::{self, has_word, normal};

/// Largest number of letters of a label. A longer text is a sentence.
const LETTERS_MAX: usize = 100;

/// Parts of the text of a cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Label {
    pub(crate) item: Option<Item>,
    pub(crate) unit: Option<WrittenUnit>,
    pub(crate) cut: Option<Cut>,
    /// Digit behind a symbol: the number of a direction, or of a specimen.
    pub(crate) suffix: Option<u32>,
    pub(crate) specimen: Option<u32>,
    pub(crate) statistic: Option<Statistic>,
    pub(crate) face: Option<Face>,
    pub(crate) axis: Option<HeadKind>,
    /// Whether the item has a name without a symbol.
    pub(crate) is_named: bool,
    /// Name of a fabric or a specimen, or a text without a meaning; empty if there is none.
    pub(crate) name: String,
}

impl Label {
    /// Splits the `text` of a cell into its parts.
    pub(crate) fn parse(text: &str) -> Self {
        let text = half_width(text);
        let mut label = Self::default();
        if text.chars().count() > LETTERS_MAX {
            label.name = text;
            return label;
        }
        if ["±", "+/-", "+-"].contains(&text.as_str()) {
            label.statistic = Some(Statistic::Deviation);
            return label;
        }

        let (outside, inside) = label.take_unit(&text);
        // A symbol that stands alone is recognised before words are.
        if inside.is_empty()
            && let Some(written) = Item::parse_symbol(&outside)
            && is_plain_symbol(&outside)
        {
            label.set_symbol(written);
            return label;
        }

        // Each step removes the words that it recognises.
        let mut words = format!(" {} {} ", normal(&outside), normal(&inside.join(" ")));
        label.take_name(&mut words, &text);
        label.take_tags(&mut words, &inside);
        label.is_named = label.item.is_some();
        label.take_symbol(&mut words);
        label.drop_condition();
        label.take_unknown_unit(&words, &inside);

        // Words that remain are a name.
        if words.chars().any(char::is_alphanumeric) {
            label.name = outside.trim().trim_end_matches([':', '：']).trim().to_owned();
        }
        label
    }

    /// Returns whether the text states a direction, a specimen, a statistic or a face.
    pub(crate) fn is_tagged(&self) -> bool {
        self.cut.is_some()
            || self.specimen.is_some()
            || self.statistic.is_some()
            || self.face.is_some()
    }

    /// Returns whether the text is a unit and nothing else.
    pub(crate) fn is_unit(&self) -> bool {
        self.unit.as_ref().is_some_and(|unit| unit.is_known)
            && self.item.is_none()
            && self.name.is_empty()
            && !self.is_tagged()
    }

    /// Returns the label with missing parts taken from `other`.
    pub(crate) fn or_from(mut self, other: &Self) -> Self {
        self.unit = self.unit.or_else(|| other.unit.clone());
        self.cut = self.cut.or(other.cut);
        self.specimen = self.specimen.or(other.specimen);
        self.statistic = self.statistic.or(other.statistic);
        self.face = self.face.or(other.face);
        if self.name.is_empty() {
            self.name.clone_from(&other.name);
        }
        self
    }

    /// Splits the unit off `text`: the whole text, behind a sign or a blank, or in brackets.
    /// Returns the text without the unit, and the texts in brackets that are no unit.
    fn take_unit(&mut self, text: &str) -> (String, Vec<String>) {
        let (mut outside, mut inside) = (text.trim().to_owned(), Vec::new());
        let is_symbol = |text: &str| Item::parse_symbol(text).is_some();
        let whole = WrittenUnit::parse(&outside, false).filter(|unit| unit.is_known);
        if let Some(unit) = whole.filter(|_| !is_symbol(text)) {
            self.unit = Some(unit);
            return (String::new(), inside);
        }
        // A unit may have brackets itself: "G, gf/(cm.deg)".
        if outside.ends_with([')', ']'])
            && let Some((words, unit)) = split_unit(&outside)
        {
            self.unit = Some(unit);
            return (words, inside);
        }

        while let Some((start, end)) = find_bracket(&outside) {
            let within = outside[start + 1..end].trim().to_owned();
            outside.replace_range(start..=end, " ");
            let unit = WrittenUnit::parse(&within, true);
            match unit.filter(|_| self.unit.is_none()) {
                Some(unit) => self.unit = Some(unit),
                None => inside.push(within),
            }
        }
        let outside = outside.trim().to_owned();
        if self.unit.is_some() || is_symbol(&outside) {
            return (outside, inside);
        }
        let Some((words, unit)) = split_unit(&outside) else { return (outside, inside) };
        self.unit = Some(unit);
        (words, inside)
    }

    /// Removes the longest name of an item from `words`, and sets the item. The load or the
    /// pressure in `text` selects among items of one name.
    fn take_name(&mut self, words: &mut String, text: &str) {
        let longest = ITEMS
            .iter()
            .flat_map(|(item, names)| single(names).map(|name| (*item, name)))
            .filter(|(_, name)| words.contains(*name) && has_word(words, name))
            .max_by_key(|(_, name)| name.chars().count());
        let Some((item, name)) = longest else { return };
        // At break, or before a body slides, the quantity is not the quantity of KES.
        if single(OTHER_TESTS).any(|word| has_word(words, word)) {
            return;
        }

        let numbers = numbers(text);
        let has = |number: f64| numbers.contains(&number);
        let is_loaded =
            ["gf", "g/cm", "n/m", "cn"].iter().any(|unit| text.to_lowercase().contains(unit));
        let item = match item {
            Item::Key("2HG") if has(5.0) && !has(0.5) => Item::Key("2HG5"),
            Item::Key("T") if is_loaded && has(0.5) => Item::Key("T0"),
            Item::Key("T") if is_loaded && has(50.0) => Item::Key("TM"),
            Item::Key("T") if is_loaded && has(2.0) => Item::Thickness(2),
            Item::Key("T") if is_loaded && has(100.0) => Item::Thickness(100),
            Item::Key("EM") | Item::Extension(_) if is_loaded && has(5.0) => Item::Extension(5),
            Item::Key("EM") | Item::Extension(_) if is_loaded && has(20.0) => Item::Extension(20),
            Item::Key("EM") | Item::Extension(_) if is_loaded && has(100.0) => Item::Extension(100),
            Item::Extension(_) if is_loaded && has(500.0) => Item::Key("EM"),
            // An extension at an unknown load is no value of KES or FAST.
            Item::Extension(_) => return,
            item => item,
        };

        // The numbers and units of the load are removed with the name.
        *words = words.replacen(name, " ", 1);
        if is_loaded || item == Item::Key("2HG5") || item == Item::Key("2HG") {
            let kept = words.split_whitespace().filter(|word| {
                let is_load = word.chars().any(|letter| letter.is_ascii_digit())
                    || ["gf", "cm2", "cm", "deg", "°"].contains(word);
                Item::parse_symbol(word).is_some() || !is_load
            });
            *words = format!(" {} ", kept.collect::<Vec<_>>().join(" "));
        }
        self.item = Some(item);
    }

    /// Removes direction, statistic, face, the head of names, and words without meaning from
    /// `words`, and sets the parts.
    fn take_tags(&mut self, words: &mut String, inside: &[String]) {
        /// Largest number of a specimen.
        const SPECIMEN_MAX: u32 = 99;

        if heading::is_bias(words) {
            self.cut = Some(Cut::Bias);
        }
        self.take_directions(words);
        if self.cut == Some(Cut::Bias) {
            words.retain(|letter| letter != '°' && letter != '±');
            *words = words.replacen("45", " ", 1).replace(" deg ", " ");
            take_words(words, BIAS);
        }

        self.take_statistic(words, inside);
        for (face, known) in [(Face::Face, FACE), (Face::Back, BACK)] {
            if take_words(words, known) {
                self.face = Some(face);
            }
        }
        self.take_head_kind(words);

        take_words(words, GENERIC);
        let rest: Vec<&str> = words.split_whitespace().collect();
        if let [number] = rest.as_slice()
            && self.item.is_none()
            && let Ok(number) = number.parse::<u32>()
            && (1..=SPECIMEN_MAX).contains(&number)
        {
            self.specimen = Some(number);
            words.clear();
        }
    }

    /// Removes the words of directions from `words`, and sets the direction if there is only one.
    fn take_directions(&mut self, words: &mut String) {
        let mut kept = Vec::new();
        let mut directions = Vec::new();
        for word in words.split_whitespace() {
            let short = word.trim_end_matches(|letter: char| letter.is_ascii_digit());
            let named = heading::directions(short).first().copied();
            let Some(direction) = named.or_else(|| spelling::direction(short)) else {
                kept.push(word);
                continue;
            };
            directions.push(direction);
            // "Warp1" has a number; "経方向" has nothing but a direction.
            kept.push(&word[short.len()..]);
        }
        *words = format!(" {} ", kept.join(" "));
        // "Warp and weft" is no direction.
        directions.dedup();
        if let ([direction], None) = (directions.as_slice(), self.cut) {
            self.cut = Some(Cut::Along(*direction));
        }
    }

    /// Removes the head of a row or column of names from `words`, and sets its kind.
    fn take_head_kind(&mut self, words: &mut String) {
        for (kind, known) in
            [(HeadKind::Specimen, SPECIMEN), (HeadKind::Fabric, FABRIC), (HeadKind::Sample, SAMPLE)]
        {
            let before = words.clone();
            if self.axis.is_none() && take_words(words, known) {
                self.axis = Some(kind);
                // "Fabric A" keeps its words, "Specimen 3" only its number.
                if kind != HeadKind::Specimen && words.split_whitespace().next().is_some() {
                    *words = before;
                    self.axis = None;
                    break;
                }
            }
        }
        if single(UNIT).any(|word| words.trim() == word) {
            self.axis = Some(HeadKind::Unit);
        }
    }

    /// Removes the words of statistics from `words`, and sets the statistic.
    fn take_statistic(&mut self, words: &mut String, inside: &[String]) {
        let found =
            [MEAN, DEVIATION, VARIATION, ERROR, OTHER].map(|known| take_words(words, known));
        let is_count =
            words.split_whitespace().all(|word| single(COUNT).any(|known| known == word))
                || single(COUNT).any(|name| name.contains(' ') && words.trim() == name);

        self.statistic = match found {
            [true, _, true, ..] => Some(Statistic::MeanWithVariation),
            [true, _, _, true, _] => Some(Statistic::MeanWithError),
            [true, ..] => Some(Statistic::Mean),
            [_, true, ..] => Some(Statistic::Deviation),
            [_, _, true, ..] => Some(Statistic::Variation),
            [_, _, _, true, _] => Some(Statistic::Error),
            [.., true] => Some(Statistic::Other),
            _ if is_count && !words.trim().is_empty() && inside.is_empty() => {
                words.clear();
                Some(Statistic::Count)
            }
            _ => None,
        };
    }

    /// Removes the symbol of an item from `words`, and sets the item: all words together, or one
    /// word of several letters. A symbol beside a name selects the item among items of one kind.
    fn take_symbol(&mut self, words: &mut String) {
        let joined: String = words.split_whitespace().collect();
        // These symbols are words of a language too.
        let is_word = |word: &str| ["to", "et", "hb", "hg", "bl", "st", "he", "rs"].contains(&word);
        let together = Item::parse_symbol(&joined).filter(|_| !is_word(&joined));
        let written = together.or_else(|| {
            words
                .split_whitespace()
                .filter(|word| word.chars().count() > 1 && !is_word(word))
                .find_map(Item::parse_symbol)
        });
        let Some(written) = written else { return };

        match self.item {
            None if together.is_none() && !is_short(words) => {}
            None => {
                self.set_symbol(written);
                words.clear();
            }
            Some(item) if are_akin(item, written.item) => {
                self.set_symbol(written);
                words.clear();
            }
            // A name is more certain than a letter: the flexural rigidity of a cantilever is G too.
            Some(_) => words.clear(),
        }
    }

    /// Takes a short text in brackets behind an item as an unknown unit, if the text is not among
    /// the recognised words.
    fn take_unknown_unit(&mut self, words: &str, inside: &[String]) {
        if self.item.is_none() || self.unit.is_some() {
            return;
        }
        /// Largest number of letters of an unknown unit.
        const LONGEST: usize = 12;

        let unit = inside.iter().find(|text| {
            let is_unrecognised =
                normal(text).split(' ').all(|word| words.contains(&format!(" {word} ")));
            let is_short = text.chars().count() <= LONGEST && !text.contains(' ');
            is_unrecognised && is_short && text.chars().any(char::is_alphabetic)
        });
        self.unit = unit.map(|text| WrittenUnit { text: text.clone(), is_known: false });
    }

    /// Removes a unit that is the unit of a load or a pressure at which the item was measured:
    /// `Thickness at 2 gf/cm²`.
    fn drop_condition(&mut self) {
        const CONDITIONS: [Quantity; 3] =
            [Quantity::Pressure, Quantity::ForcePerWidth, Quantity::Angle];
        let (Some(unit), Some(quantity)) = (&self.unit, self.item.and_then(Item::quantity)) else {
            return;
        };
        let is_of_item = parse_unit(&unit.text, &[quantity]).is_ok();
        if !is_of_item && parse_unit(&unit.text, &CONDITIONS).is_ok() {
            self.unit = None;
        }
    }

    /// Sets the item, the suffix and the face of a symbol.
    fn set_symbol(&mut self, written: WrittenSymbol) {
        self.is_named = false;
        self.item = Some(written.item);
        self.suffix = written.suffix;
        let face = written.sign.map(|sign| if sign == '+' { Face::Face } else { Face::Back });
        self.face = self.face.or(face);
    }
}

/// Returns whether `text` is short enough for a symbol with signs and digits.
fn is_plain_symbol(text: &str) -> bool {
    text.split_whitespace().count() <= 2 && text.chars().count() <= 9
}

/// Returns whether `words` are at most four, so that a symbol among them is the symbol of an item.
fn is_short(words: &str) -> bool {
    words.split_whitespace().count() <= 4
}

/// Returns whether `symbol` may stand beside the name of the item `named`: both are of one kind.
fn are_akin(named: Item, symbol: Item) -> bool {
    named == symbol || (kind(named) > 0 && kind(named) == kind(symbol))
}

/// Returns a number for the kind of items that share names; 0 for items with a name that no other
/// item has.
fn kind(item: Item) -> u32 {
    match item {
        Item::Key("2HG" | "2HG5") => 1,
        Item::Key("T" | "T0" | "TM") | Item::Thickness(_) => 2,
        Item::Key("EM") | Item::Extension(_) | Item::BiasExtension => 3,
        Item::Key("MIU" | "MMD") => 4,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test::Direction;

    const WARP: Option<Cut> = Some(Cut::Along(Direction::Warp));
    const WEFT: Option<Cut> = Some(Cut::Along(Direction::Weft));

    #[test]
    fn symbols_and_names_of_items_are_told_with_their_units() {
        let cases = [
            ("B (gf.cm2/cm)", Item::Key("B"), Some("gf.cm2/cm")),
            ("B, gf.cm2/cm", Item::Key("B"), Some("gf.cm2/cm")),
            ("LT, -", Item::Key("LT"), Some("-")),
            ("G (gf/(cm.deg))", Item::Key("G"), Some("gf/(cm.deg)")),
            ("G, gf/(cm.deg)", Item::Key("G"), Some("gf/(cm.deg)")),
            ("2HG gf/cm", Item::Key("2HG"), Some("gf/cm")),
            ("Weight g/m2", Item::Key("W"), Some("g/m2")),
            ("Weight in g/m²", Item::Key("W"), Some("g/m²")),
            ("E5-1 %", Item::Extension(5), Some("%")),
            ("Bending rigidity B [gf·cm²/cm]", Item::Key("B"), Some("gf·cm²/cm")),
            ("Flexural rigidity, G (mg.cm)", Item::Key("B"), Some("mg.cm")),
            ("曲げ剛性 Ｂ（ｇｆ・ｃｍ２／ｃｍ）", Item::Key("B"), Some("gf・cm2/cm")),
            ("せん断ヒステリシス 2HG5 (gf/cm)", Item::Key("2HG5"), Some("gf/cm")),
            ("Shear hysteresis at 5° (gf/cm)", Item::Key("2HG5"), Some("gf/cm")),
            ("Shear hysteresis at 0.5° (gf/cm)", Item::Key("2HG"), Some("gf/cm")),
            ("Biegesteifigkeit", Item::Key("B"), None),
            ("Thickness at 0.5 gf/cm² (mm)", Item::Key("T0"), Some("mm")),
            ("Thickness T0 (mm)", Item::Key("T0"), Some("mm")),
            ("Extension at 20 gf/cm (%)", Item::Extension(20), Some("%")),
            ("Extension at 20 gf/cm", Item::Extension(20), None),
            ("Épaisseur à 0,5 gf/cm²", Item::Key("T0"), None),
            ("弯曲刚度 B", Item::Key("B"), None),
            ("Elongation EMT (%)", Item::Key("EM"), Some("%")),
            ("T_0", Item::Key("T0"), None),
            ("T₀ (mm)", Item::Key("T0"), Some("mm")),
            ("To (mm)", Item::Key("T0"), Some("mm")),
            ("2HG 5", Item::Key("2HG5"), None),
            ("Kalınlık (mm)", Item::Key("T"), Some("mm")),
        ];
        for (text, item, unit) in cases {
            let label = Label::parse(text);
            let found = label.unit.as_ref().map(|unit| unit.text.as_str());
            assert_eq!((label.item, found), (Some(item), unit), "{text}: {label:?}");
        }
        for text in
            ["Fabric: B 12", "Class B", "Chaîne et trame", "Strain (%)", "Force (gf/cm)", "mean"]
        {
            assert_eq!(Label::parse(text).item, None, "{text}");
        }
    }

    #[test]
    fn heads_of_columns_name_direction_specimen_statistic_and_face() {
        use Statistic::{Count, Deviation, Mean, MeanWithVariation, Variation};
        let tags = |text: &str| {
            let label = Label::parse(text);
            assert_eq!((label.item, label.name.as_str()), (None, ""), "{text}: {label:?}");
            (label.cut, label.specimen, label.statistic, label.face)
        };
        assert_eq!(tags("Warp direction"), (WARP, None, None, None));
        assert_eq!(tags("Warp 2"), (WARP, Some(2), None, None));
        assert_eq!(tags("Warp2"), (WARP, Some(2), None, None));
        assert_eq!(tags("Schuss Mittelwert"), (WEFT, None, Some(Mean), None));
        assert_eq!(tags("Weft back"), (WEFT, None, None, Some(Face::Back)));
        assert_eq!(tags("たて方向"), (WARP, None, None, None));
        assert_eq!(tags("3"), (None, Some(3), None, None));
        assert_eq!(tags("Specimen 3"), (None, Some(3), None, None));
        assert_eq!(tags("Mean ± SD"), (None, None, Some(Mean), None));
        assert_eq!(tags("Mean (CV%)"), (None, None, Some(MeanWithVariation), None));
        assert_eq!(tags("標準偏差"), (None, None, Some(Deviation), None));
        assert_eq!(tags("CV%"), (None, None, Some(Variation), None));
        assert_eq!(tags("Warp and weft"), (None, None, None, None));
        assert_eq!(tags("n"), (None, None, Some(Count), None));
        assert_eq!(tags("Value"), (None, None, None, None));
        assert_eq!(tags("45°").0, Some(Cut::Bias));
        let label = Label::parse("B warp");
        assert_eq!((label.item, label.cut), (Some(Item::Key("B")), WARP));
        let label = Label::parse("B (warp)");
        assert_eq!((label.item, label.cut), (Some(Item::Key("B")), WARP));
        let label = Label::parse("G (gf/(cm.deg)) warp");
        assert_eq!((label.item, label.cut), (Some(Item::Key("G")), WARP));
        let label = Label::parse("B-2");
        assert_eq!((label.item, label.suffix), (Some(Item::Key("B")), Some(2)));
        assert_eq!(Label::parse("Specimen").axis, Some(HeadKind::Specimen));
        assert_eq!(Label::parse("Fabric:").axis, Some(HeadKind::Fabric));
        assert_eq!(Label::parse("Sample").axis, Some(HeadKind::Sample));
        assert_eq!(Label::parse("Fabric A").name, "Fabric A");
        assert_eq!(Label::parse("sateen 11").name, "sateen 11");
    }
}
