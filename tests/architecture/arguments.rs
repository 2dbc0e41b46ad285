//! Arguments of functions, counted in the tokens of their signatures.

/// Returns the names of the functions that take more than some number of arguments; `self` does not
/// count, and neither do the arguments of closures and of function types.
pub fn functions_with_more_arguments(tokens: &[String], most: usize) -> Vec<String> {
    let starts = tokens.windows(2).enumerate().filter(|(_, words)| words[0] == "fn");
    let named = starts.filter(|(_, words)| words[1].starts_with(|c: char| c.is_alphabetic()));
    let many = named.filter(|(start, _)| arguments(&tokens[start + 2..]) > most);
    many.map(|(_, words)| words[1].clone()).collect()
}

/// Counts the arguments of a signature, which begins behind the name of its function.
fn arguments(signature: &[String]) -> usize {
    let mut depth = 0;
    let mut open = None;
    let mut before = "";
    let mut own: Vec<Vec<&str>> = vec![Vec::new()];
    for token in signature {
        let token = token.as_str();
        let arrow = matches!(before, "-" | "=");
        match token {
            "(" if depth == 0 && open.is_none() => open = Some(depth),
            "(" | "[" | "{" | "<" => depth += 1,
            ")" if depth == 0 && open.is_some() => break,
            ">" if arrow => {}
            ")" | "]" | "}" | ">" => depth -= 1,
            "," if depth == 0 && open.is_some() => own.push(Vec::new()),
            _ => {}
        }
        if open.is_some() && (depth > 0 || !matches!(token, "(" | ",")) {
            own.last_mut().expect("there is one").push(token);
        }
        before = token;
    }
    let is_own = |words: &&Vec<&str>| {
        let name = words.iter().find(|word| !matches!(**word, "&" | "mut"));
        name.is_some_and(|name| *name != "self")
    };
    own.iter().filter(is_own).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tokens::tokens;

    #[test]
    fn arguments_are_counted_without_self_and_without_those_inside() {
        let count = |text: &str| arguments(&tokens(text));
        assert_eq!(count("()"), 0);
        assert_eq!(count("(&mut self, a: f64, [b, c]: [f64; 2],) -> (u8, u8) {}"), 2);
        assert_eq!(count("<'a, T: Fn(u8) -> u8, const N: usize>(a: &'a [T; N], b: u8)"), 2);
        assert_eq!(count("(a: impl Fn(u8, u8) -> (u8, u8), b: BTreeMap<u8, u8>, c: u8)"), 3);
        let text = "fn f(a: u8, b: u8, c: u8) {} fn g(self, a: u8, b: u8) { fn h() {} }";
        assert_eq!(functions_with_more_arguments(&tokens(text), 2), ["f"]);
    }
}
