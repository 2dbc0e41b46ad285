//! Text of the report of a fit, for a terminal.

use drape_input::{percent, signed_percent, significant};

use super::fit_page::{FitPage, KesValue};
use super::law_report::{LawReport, Limits, Statistics, Trust};
use super::shown::{Shown, ShownLawValue, ShownParameter, ShownValue};
use crate::error::Error;
use crate::text::table::Table;

/// Width at which running text is broken, in letters. The width is larger than the usual 80 of a
/// terminal, because tables are wider than 80 letters.
const WIDTH: usize = 96;

impl FitPage {
    /// Returns the report as text for a terminal, in columns.
    ///
    /// # Errors
    /// Errors of [`FitPage::check`].
    pub fn to_text(&self) -> Result<String, Error> {
        self.check()?;
        Ok(render(self))
    }
}

/// Returns the text of a `page` that has been checked.
fn render(page: &FitPage) -> String {
    let mut lines = vec![page.name.clone(), "=".repeat(page.name.chars().count())];
    for text in [&page.source, &page.provenance, &page.version] {
        wrap(&mut lines, "", text);
    }

    if !page.quantities.is_empty() {
        lines.push(String::new());
        lines.extend(quantities(page));
    }
    if !page.readings.is_empty() {
        heading(&mut lines, "Read");
        page.readings.iter().for_each(|text| wrap(&mut lines, "  - ", text));
    }

    for law in &page.laws {
        lines.push(String::new());
        lines.extend(law_lines(law, &page.limits));
    }
    if !page.values.is_empty() {
        heading(&mut lines, "KES values");
        lines.extend(values(&page.values, &page.limits));
    }

    let lists = [
        ("Assumed, not measured", &page.assumed),
        ("Repaired", &page.repairs),
        ("Warnings", &page.warnings),
    ];
    for (title, texts) in lists {
        if !texts.is_empty() {
            heading(&mut lines, title);
            for text in texts {
                wrap(&mut lines, "  - ", text);
            }
        }
    }
    lines.push(String::new());
    lines.join("\n")
}

/// Adds a heading with a `title`, after an empty line.
fn heading(lines: &mut Vec<String>, title: &str) {
    lines.push(String::new());
    lines.push(format!("[{title}]"));
}

/// Adds a `text` to `lines`, broken at blanks. The first line starts with `begin`. Further lines
/// are indented by the width of `begin`.
fn wrap(lines: &mut Vec<String>, begin: &str, text: &str) {
    let indent = " ".repeat(begin.chars().count());
    let mut line = begin.to_owned();
    let mut begun = false;
    for word in text.split_whitespace() {
        if begun && line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(std::mem::replace(&mut line, indent.clone()));
            begun = false;
        }
        if begun {
            line.push(' ');
        }
        line.push_str(word);
        begun = true;
    }
    if begun {
        lines.push(line);
    }
}

/// Returns the table of the given quantities of a `page`.
fn quantities(page: &FitPage) -> Vec<String> {
    let mut table = Table::new(&["given", "", "", "SI", "", ""], &[1, 3]);
    for quantity in &page.quantities {
        let ShownValue { kes, si } = ShownValue::new(quantity.value, &quantity.units);
        table.row(vec![
            quantity.name.clone(),
            kes.as_ref().map_or_else(String::new, Shown::number),
            kes.map_or_else(String::new, |kes| kes.unit),
            si.number(),
            si.unit,
            quantity.origin.clone(),
        ]);
    }
    table.lines(0)
}

/// Returns the lines of a `law`, which is judged by `limits`.
fn law_lines(law: &LawReport, limits: &Limits) -> Vec<String> {
    let verdict = law.verdict(limits);
    let mut lines = vec![format!("[{}]  {}", law.title, verdict.trust.name())];
    if verdict.trust > Trust::Good {
        for reason in &verdict.reasons {
            wrap(&mut lines, "  ! ", reason);
        }
    }

    fact(&mut lines, "law", &law.model);
    if let Some(statistics) = &law.statistics {
        statistics_lines(&mut lines, law, statistics);
    }
    if !law.values.is_empty() {
        lines.extend(law_values(law, limits));
    }
    if !law.models.is_empty() {
        lines.extend(models(law));
    }
    if !law.parameters.is_empty() {
        lines.extend(parameters(law));
    }

    if let Some(correlation) = &law.correlation {
        let pairs = correlation.above(limits.correlation);
        if !pairs.is_empty() {
            lines.push(format!("  correlations above {}", limits.correlation));
            for pair in pairs {
                let [a, b] = pair.symbols.map(|symbol| law.named(symbol));
                lines.push(format!("    {a} and {b}: {:.3}", pair.correlation));
            }
        }
    }

    for note in &law.notes {
        wrap(&mut lines, "  - ", note);
    }
    lines
}

/// Adds a fact of a law: its `name` in a column, then its `text`.
fn fact(lines: &mut Vec<String>, name: &str, text: &str) {
    wrap(lines, &format!("  {name:<8} "), text);
}

/// Adds the `statistics` of the fit of a `law`.
fn statistics_lines(lines: &mut Vec<String>, law: &LawReport, statistics: &Statistics) {
    let unit = law.load_unit();
    let rms = format!("{} {}", significant(statistics.rms / unit.in_si, 3), unit.name);
    let misfit = format!(
        "{} of the range (rms {}), R² {:.5}, {} points",
        percent(statistics.misfit),
        rms.trim_end(),
        statistics.r_squared,
        statistics.points
    );
    fact(lines, "misfit", &misfit);
    let search = format!(
        "{} after {} iterations and {} evaluations",
        statistics.stop, statistics.iterations, statistics.evaluations
    );
    fact(lines, "stopped", &search);
}

/// Returns the table of the models that were compared for a `law`.
fn models(law: &LawReport) -> Vec<String> {
    let head = ["model", "parameters", "misfit", "AICc", "above best", "weight", "last cycle", ""];
    let mut table = Table::new(&head, &[1, 2, 3, 4, 5, 6]);
    for (model, evidence) in law.models.iter().zip(law.evidence()) {
        table.row(vec![
            model.name.clone(),
            model.parameters.to_string(),
            percent(model.misfit),
            format!("{:.1}", model.aicc),
            format!("{:.1}", evidence.above_best),
            format!("{:.3}", evidence.weight),
            model.prediction.map_or_else(String::new, percent),
            if model.chosen { "chosen" } else { "" }.to_owned(),
        ]);
    }
    table.lines(2)
}

/// Returns the table of the KES values of a `law`. Errors beyond `limits` have a sign.
fn law_values(law: &LawReport, limits: &Limits) -> Vec<String> {
    let head = ["value", "", "curve", "law", "", "error", "95 % interval"];
    let mut table = Table::new(&head, &[2, 3, 5, 6]);
    for value in &law.values {
        let shown = ShownLawValue::new(value);
        let is_wide = limits.is_uncertain(value);
        table.row(vec![
            value.symbol.clone(),
            value.name.clone(),
            shown.curve.as_ref().map_or_else(String::new, Shown::number),
            shown.law.number(),
            shown.law.unit.clone(),
            format!("{}{}", shown.relative, if is_wide { " !" } else { "" }),
            shown.interval,
        ]);
    }
    table.lines(2)
}

/// Returns the table of the parameters of a `law`, then the reasons for missing intervals.
fn parameters(law: &LawReport) -> Vec<String> {
    let head = ["parameter", "", "value", "", "error", "95 % interval", "SI value", ""];
    let mut table = Table::new(&head, &[2, 4, 5, 6]);
    let mut reasons = Vec::new();
    for parameter in &law.parameters {
        let shown = ShownParameter::new(parameter);
        let first = shown.first();
        let si = shown.kes.as_ref().map(|_| &shown.si);

        table.row(vec![
            parameter.symbol.clone(),
            parameter.name.clone(),
            first.number(),
            first.unit.clone(),
            shown.relative.clone(),
            shown.interval.clone(),
            si.map_or_else(String::new, |si| format!("{}{}", si.value, si.power)),
            si.map_or_else(String::new, |si| si.unit.clone()),
        ]);

        if let Some(reason) = shown.reason {
            wrap(&mut reasons, &format!("    {}: ", parameter.symbol), reason);
        }
    }
    let mut lines = table.lines(2);
    lines.extend(reasons);
    lines
}

/// Returns the table of KES `values`. Differences beyond `limits` have a sign.
fn values(values: &[KesValue], limits: &Limits) -> Vec<String> {
    let head = ["", "", "", "unit", "sheet", "curve", "", "law", "", "", "SI", ""];
    let mut table = Table::new(&head, &[4, 5, 6, 7, 8, 10]);
    for value in values {
        let shown = |number: Option<f64>| {
            number.map_or_else(String::new, |number| {
                ShownValue::new(number, &value.units).first().number()
            })
        };
        let differences = value.differences();
        let difference = |ratio: Option<f64>| ratio.map_or_else(String::new, signed_percent);
        let apart = differences.iter().flatten().any(|d| d.abs() > limits.difference);

        // The column of SI is empty for a value that is already shown in SI.
        let best = value.sheet.or(value.curve).or(value.law);
        let si = best.filter(|_| value.units.kes.is_some());
        let si = si.map(|number| Shown::bare(number, &value.units.si));
        table.row(vec![
            value.symbol.clone(),
            value.direction.clone(),
            value.name.clone(),
            value.units.first().0.to_owned(),
            shown(value.sheet),
            shown(value.curve),
            difference(differences[0]),
            shown(value.law),
            difference(differences[1]),
            if apart { "!" } else { "" }.to_owned(),
            si.as_ref().map_or_else(String::new, Shown::number),
            si.map_or_else(String::new, |si| si.unit),
        ]);
    }
    table.lines(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_as_full_as_their_width_allows() {
        let words: Vec<String> = (0..200).map(|k| "x".repeat(1 + k * k % 11)).collect();
        let mut lines = Vec::new();
        wrap(&mut lines, "  notes    ", &words.join("  "));
        assert!(lines[0].starts_with("  notes    ") && lines[1].starts_with("           "));
        let texts: Vec<&str> = lines.iter().map(|line| &line[11..]).collect();
        assert_eq!(texts.join(" "), words.join(" "));
        for pair in lines.windows(2) {
            let next = pair[1].split_whitespace().next().expect("a word");
            assert!(pair[0].len() <= WIDTH && pair[0].len() + 1 + next.len() > WIDTH, "{pair:?}");
        }
    }
}
