//! Text of a cell beside numbers, taken apart: item, unit, direction, specimen, statistic, face,
//! name.

pub(crate) mod letters;
mod names;
mod tags;
pub(crate) mod written_unit;

pub(crate) use self::tags::{Axis, Cut, Face, Statistic};

use drape_input::{Quantity, parse_unit};

use crate::results::item::Item;
use crate::results::label::letters::{half_width, numbers, take};
use crate::results::label::names::{
    BACK, COUNT, DEVIATION, ERROR, FABRIC, FACE, GENERIC, ITEMS, MEAN, OTHER, OTHER_TESTS, SAMPLE,
    SPECIMEN, UNIT, VARIATION,
};
use crate::results::label::written_unit::{WrittenUnit, behind_sign, bracket};
use crate::sheets::spelling;
use crate::tables::heading::words::single;
use crate::tables::heading::{self, has_word, normal};

/// Letters of a label at most: a longer text is a sentence.
const LETTERS_MAX: usize = 100;
/// Letters of a unit that is not known, at most.
const UNKNOWN_UNIT_MAX: usize = 12;
/// Number of a specimen at most.
const SPECIMEN_MAX: u32 = 99;

/// Parts of the text of a cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Label {
    pub(crate) item: Option<Item>,
    pub(crate) unit: Option<WrittenUnit>,
    pub(crate) cut: Option<Cut>,
    /// Number behind a symbol: that of a direction, or of a specimen.
    pub(crate) suffix: Option<u32>,
    pub(crate) specimen: Option<u32>,
    pub(crate) statistic: Option<Statistic>,
    pub(crate) face: Option<Face>,
    pub(crate) axis: Option<Axis>,
    /// Whether the item is known by its name alone, without a symbol.
    pub(crate) is_named: bool,
    /// Text that is nothing of the above; empty where there is none.
    pub(crate) name: String,
}

impl Label {
    /// Takes the text of a cell apart.
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
        // A symbol alone, with what its signs mean, goes before words.
        if inside.is_empty()
            && let Some(written) = Item::of_symbol(&outside)
            && is_plain_symbol(&outside)
        {
            label.set_symbol(written);
            return label;
        }
        let mut words = format!(" {} {} ", normal(&outside), normal(&inside.join(" ")));
        label.take_name(&mut words, &text);
        label.take_tags(&mut words, &inside);
        label.is_named = label.item.is_some();
        label.take_symbol(&mut words);
        label.drop_condition();
        label.take_unknown_unit(&words, &inside);
        let rest: Vec<&str> = words.split_whitespace().collect();
        let is_said = |word: &&str| word.chars().any(char::is_alphanumeric);
        if rest.iter().any(is_said) {
            label.name = outside.trim().trim_end_matches([':', '：']).trim().to_owned();
        }
        label
    }

    /// Returns whether the text says anything but a name.
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

    /// Returns the label with what it does not say taken from another.
    pub(crate) fn or(mut self, other: &Self) -> Self {
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

    /// Takes the unit: the whole text, behind a sign or a blank, or in brackets. Returns the text
    /// without it, and the texts in brackets that are no unit.
    fn take_unit(&mut self, text: &str) -> (String, Vec<String>) {
        let (mut outside, mut inside) = (text.trim().to_owned(), Vec::new());
        let is_symbol = |text: &str| Item::of_symbol(text).is_some();
        let whole = WrittenUnit::of(&outside, false).filter(|unit| unit.is_known);
        if let Some(unit) = whole.filter(|_| !is_symbol(text)) {
            self.unit = Some(unit);
            return (String::new(), inside);
        }
        // A unit may have brackets: "G, gf/(cm.deg)".
        if outside.ends_with([')', ']'])
            && let Some((words, unit)) = behind_sign(&outside)
        {
            self.unit = Some(unit);
            return (words, inside);
        }
        while let Some((start, end)) = bracket(&outside) {
            let within = outside[start + 1..end].trim().to_owned();
            outside.replace_range(start..=end, " ");
            let unit = WrittenUnit::of(&within, true);
            match unit.filter(|_| self.unit.is_none()) {
                Some(unit) => self.unit = Some(unit),
                None => inside.push(within),
            }
        }
        let outside = outside.trim().to_owned();
        if self.unit.is_some() || is_symbol(&outside) {
            return (outside, inside);
        }
        let Some((words, unit)) = behind_sign(&outside) else { return (outside, inside) };
        self.unit = Some(unit);
        (words, inside)
    }

    /// Takes the longest name of an item, with the load or the pressure that it names.
    fn take_name(&mut self, words: &mut String, text: &str) {
        let all = ITEMS.iter().flat_map(|(item, names)| single(names).map(|name| (*item, name)));
        let there = all.filter(|(_, name)| words.contains(*name) && has_word(words, name));
        let Some((item, name)) = there.max_by_key(|(_, name)| name.chars().count()) else { return };
        // At break, or before a body slides, the quantity is another one.
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
            // An extension at a load that is not told is no value of either system.
            Item::Extension(_) => return,
            item => item,
        };
        *words = words.replacen(name, " ", 1);
        let is_condition = |word: &str| word.chars().any(|letter| letter.is_ascii_digit());
        if is_loaded || item == Item::Key("2HG5") || item == Item::Key("2HG") {
            let kept = words.split_whitespace().filter(|word| {
                let symbol = Item::of_symbol(word).is_some();
                symbol || !(is_condition(word) || ["gf", "cm2", "cm", "deg", "°"].contains(word))
            });
            *words = format!(" {} ", kept.collect::<Vec<_>>().join(" "));
        }
        self.item = Some(item);
    }

    /// Takes direction, statistic, face, the head of an axis, and words that say nothing.
    fn take_tags(&mut self, words: &mut String, inside: &[String]) {
        if heading::is_bias(words) {
            self.cut = Some(Cut::Bias);
        }
        let mut kept = Vec::new();
        let mut named_directions = Vec::new();
        for word in words.split_whitespace() {
            let short = word.trim_end_matches(|letter: char| letter.is_ascii_digit());
            let named = heading::directions(short).first().copied();
            let direction = named.or_else(|| spelling::direction(short));
            let Some(direction) = direction else {
                kept.push(word.to_owned());
                continue;
            };
            named_directions.push(direction);
            // "Warp1" has a number, "経方向" says no more than a direction.
            kept.push(word[short.len()..].to_owned());
        }
        *words = format!(" {} ", kept.join(" "));
        // "Warp and weft" is neither.
        named_directions.dedup();
        if let ([direction], None) = (named_directions.as_slice(), self.cut) {
            self.cut = Some(Cut::Along(*direction));
        }
        if self.cut == Some(Cut::Bias) {
            words.retain(|letter| letter != '°' && letter != '±');
            *words = words.replacen("45", " ", 1).replace(" deg ", " ");
            take(
                words,
                &[
                    "bias, biais, sbieco, bies, sesgo, viés, verev, schräg, diagonal, バイアス, 斜め, 斜向",
                ],
            );
        }
        self.take_statistic(words, inside);
        for (face, known) in [(Face::Face, FACE), (Face::Back, BACK)] {
            if take(words, known) {
                self.face = Some(face);
            }
        }
        for (axis, known) in
            [(Axis::Specimen, SPECIMEN), (Axis::Fabric, FABRIC), (Axis::Sample, SAMPLE)]
        {
            let before = words.clone();
            if self.axis.is_none() && take(words, known) {
                self.axis = Some(axis);
                // "Fabric A" keeps its words, "Specimen 3" its number.
                if axis != Axis::Specimen && words.split_whitespace().next().is_some() {
                    *words = before;
                    self.axis = None;
                    break;
                }
            }
        }
        if single(UNIT).any(|word| words.trim() == word) {
            self.axis = Some(Axis::Unit);
        }
        take(words, GENERIC);
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

    fn take_statistic(&mut self, words: &mut String, inside: &[String]) {
        let taken = [MEAN, DEVIATION, VARIATION, ERROR, OTHER].map(|known| take(words, known));
        let is_count =
            words.split_whitespace().all(|word| single(COUNT).any(|known| known == word))
                || single(COUNT).any(|name| name.contains(' ') && words.trim() == name);
        self.statistic = match taken {
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

    /// Takes the symbol of an item: the words together, or one word of several letters among
    /// others. A symbol beside a name says which of its kind it is.
    fn take_symbol(&mut self, words: &mut String) {
        let joined: String = words.split_whitespace().collect();
        // Symbols that are words of a language too.
        let is_word = |word: &str| ["to", "et", "hb", "hg", "bl", "st", "he", "rs"].contains(&word);
        let together = Item::of_symbol(&joined).filter(|_| !is_word(&joined));
        let long = |word: &&str| word.chars().count() > 1 && !is_word(word);
        let single = || words.split_whitespace().filter(long).find_map(Item::of_symbol);
        let Some(written) = together.or_else(single) else { return };
        match self.item {
            None if together.is_none() && !is_alone_enough(words) => {}
            None => {
                self.set_symbol(written);
                words.clear();
            }
            Some(item) if are_akin(item, written.item) => {
                self.set_symbol(written);
                words.clear();
            }
            // A name tells more than a letter: the flexural rigidity of a cantilever is G too.
            Some(_) => words.clear(),
        }
    }

    /// Takes a text in brackets behind an item for a unit that is not known, where it is none of
    /// the words.
    fn take_unknown_unit(&mut self, words: &str, inside: &[String]) {
        if self.item.is_none() || self.unit.is_some() {
            return;
        }
        let is_unit = |text: &&String| {
            let is_left = normal(text).split(' ').all(|word| words.contains(&format!(" {word} ")));
            let is_short = text.chars().count() <= UNKNOWN_UNIT_MAX && !text.contains(' ');
            is_left && is_short && text.chars().any(char::is_alphabetic)
        };
        let unit = inside.iter().find(is_unit).cloned();
        self.unit = unit.map(|text| WrittenUnit { text, is_known: false });
    }

    /// Removes the unit of a load or a pressure at which the item was measured:
    /// `Thickness at 2 gf/cm²`.
    fn drop_condition(&mut self) {
        const CONDITIONS: [Quantity; 3] =
            [Quantity::Pressure, Quantity::ForcePerWidth, Quantity::Angle];
        let (Some(unit), Some(quantity)) = (&self.unit, self.item.and_then(Item::quantity)) else {
            return;
        };
        let is_own = parse_unit(&unit.text, &[quantity]).is_ok();
        if !is_own && parse_unit(&unit.text, &CONDITIONS).is_ok() {
            self.unit = None;
        }
    }

    fn set_symbol(&mut self, written: crate::results::item::Written) {
        self.is_named = false;
        self.item = Some(written.item);
        self.suffix = written.suffix;
        let face = written.sign.map(|sign| if sign == '+' { Face::Face } else { Face::Back });
        self.face = self.face.or(face);
    }
}

/// Returns whether a symbol stands alone: with signs and digits, but no word.
fn is_plain_symbol(text: &str) -> bool {
    text.split_whitespace().count() <= 2 && text.chars().count() <= 9
}

/// Returns whether a text is so short, four words at most, that a symbol in it is the symbol of an
/// item.
fn is_alone_enough(words: &str) -> bool {
    words.split_whitespace().count() <= 4
}

/// Returns whether a symbol may stand beside a name of another item of its kind.
fn are_akin(named: Item, symbol: Item) -> bool {
    let kind = |item: Item| match item {
        Item::Key("2HG" | "2HG5") => 1,
        Item::Key("T" | "T0" | "TM") | Item::Thickness(_) => 2,
        Item::Key("EM") | Item::Extension(_) | Item::BiasExtension => 3,
        Item::Key("MIU" | "MMD") => 4,
        _ => 0,
    };
    named == symbol || (kind(named) > 0 && kind(named) == kind(symbol))
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
        assert_eq!(Label::parse("Specimen").axis, Some(Axis::Specimen));
        assert_eq!(Label::parse("Fabric:").axis, Some(Axis::Fabric));
        assert_eq!(Label::parse("Sample").axis, Some(Axis::Sample));
        assert_eq!(Label::parse("Fabric A").name, "Fabric A");
        assert_eq!(Label::parse("sateen 11").name, "sateen 11");
    }
}
