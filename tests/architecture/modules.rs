//! Modules of a crate and the uses between them, read from the text of its files.
//!
//! A file is a module. It uses another one if a path outside `#[cfg(test)]` leads to an item that
//! is defined there: `crate::…`, `self::…`, `super::…`, or through an imported name; re-exports are
//! followed to the definition. A parent does not use its children by declaring or re-exporting
//! them. Methods are not seen, since they are called without a path.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::{Path, PathBuf};

use super::tokens::{tokens, without_tests};

/// Path of a module or an item, from the root of its crate.
type Segments = Vec<String>;

/// A module, and what its text says of others.
#[derive(Default)]
struct Module {
    /// Modules that it declares in files of their own.
    children: BTreeSet<String>,
    /// Names that it imports, with the paths that they stand for.
    imports: BTreeMap<String, Segments>,
    /// Paths that it uses.
    paths: BTreeSet<Segments>,
}

/// Modules of a crate by their paths; that of the root is empty.
pub struct Modules(BTreeMap<Segments, Module>);

/// Modules that each module uses, each with the path that shows it.
type Uses = BTreeMap<Segments, BTreeMap<Segments, String>>;

impl Modules {
    /// Reads the root file of a crate and the files of all its modules.
    pub fn read(root: &Path) -> Self {
        Self::from_files(root, &|path| std::fs::read_to_string(path).ok())
    }

    /// Reads modules whose files `text` gives.
    fn from_files(root: &Path, text: &dyn Fn(&Path) -> Option<String>) -> Self {
        let folder = root.parent().expect("a file is in a folder").to_owned();
        let mut modules = BTreeMap::new();
        let mut open: VecDeque<(Segments, PathBuf, PathBuf)> =
            [(Segments::new(), root.to_owned(), folder)].into();
        while let Some((path, file, folder)) = open.pop_front() {
            let text_of = text(&file).unwrap_or_else(|| panic!("there is no {}", file.display()));
            let module = Module::parse(&without_tests(&tokens(&text_of)), &path);
            for child in &module.children {
                let inside = folder.join(child);
                let beside = folder.join(format!("{child}.rs"));
                let file = if text(&beside).is_some() { beside } else { inside.join("mod.rs") };
                open.push_back((join(&path, child), file, inside));
            }
            modules.insert(path, module);
        }
        Self(modules)
    }

    /// Returns circles of uses that share no module, in words, the shortest first.
    pub fn circles(&self) -> Vec<String> {
        let uses = self.uses();
        let mut circles: Vec<_> =
            uses.keys().filter_map(|start| shortest_circle(&uses, start)).collect();
        circles.sort_by_key(Vec::len);
        let mut seen = BTreeSet::new();
        circles.retain(|circle| {
            let new = circle.iter().all(|module| !seen.contains(module));
            seen.extend(circle.iter().cloned());
            new
        });
        circles.iter().map(|circle| in_words(circle, &uses)).collect()
    }

    /// Returns the uses that run up, in words: `chapters` are modules of the root, and each may use
    /// those before it in the list. Modules that are in no chapter may use all, and be used by all.
    pub fn arrows_up(&self, chapters: &[String]) -> Vec<String> {
        let chapter = |module: &Segments| {
            let name = module.first()?;
            chapters.iter().position(|chapter| chapter == name)
        };
        let mut arrows = Vec::new();
        for (user, targets) in self.uses() {
            for (target, path) in targets {
                let above = chapter(&user).zip(chapter(&target)).is_some_and(|(a, b)| a < b);
                if above {
                    arrows.push(format!("{} uses {path}", user.join("::")));
                }
            }
        }
        arrows
    }

    /// Returns whether a crate has a module of this name at its root.
    pub fn has(&self, chapter: &str) -> bool {
        self.0.contains_key(&[chapter.to_owned()][..])
    }

    fn uses(&self) -> Uses {
        let mut uses = Uses::new();
        for (user, module) in &self.0 {
            let used = uses.entry(user.clone()).or_default();
            for path in &module.paths {
                if let Some(target) = self.definition(path, 0).filter(|target| target != user) {
                    used.entry(target).or_insert_with(|| path.join("::"));
                }
            }
        }
        uses
    }

    /// Returns the module that defines what a path leads to; none for a bare module.
    fn definition(&self, path: &[String], depth: usize) -> Option<Segments> {
        let length = (0..=path.len()).rev().find(|&length| self.0.contains_key(&path[..length]))?;
        let (module, item) = path.split_at(length);
        let (name, rest) = item.split_first()?;
        match self.0[module].imports.get(name) {
            // An import may have the name of what it imports, so chains of them could go on.
            Some(import) if depth < 16 => self.definition(&[import, rest].concat(), depth + 1),
            _ => Some(module.to_vec()),
        }
    }
}

fn join(path: &[String], name: &str) -> Segments {
    [path, &[name.to_owned()]].concat()
}

/// Names the modules of a circle, each with the path by which it uses the next.
fn in_words(circle: &[Segments], uses: &Uses) -> String {
    let name = |module: &Segments| match module.is_empty() {
        true => "the root".to_owned(),
        false => module.join("::"),
    };
    let next = circle.iter().cycle().skip(1);
    let uses = circle.iter().zip(next).map(|(from, to)| {
        format!("{} uses {} (`crate::{}`)", name(from), name(to), uses[from][to])
    });
    uses.collect::<Vec<_>>().join(", ")
}

/// Returns the modules of the shortest circle through one of them, each using the next.
fn shortest_circle(uses: &Uses, start: &Segments) -> Option<Vec<Segments>> {
    let mut before: BTreeMap<&Segments, &Segments> = BTreeMap::new();
    let mut open: VecDeque<&Segments> = [start].into();
    while let Some(module) = open.pop_front() {
        for target in uses.get(module).into_iter().flat_map(BTreeMap::keys) {
            if target == start {
                let chain = std::iter::successors(Some(module), |m| before.get(m).copied());
                let mut circle: Vec<Segments> = chain.cloned().collect();
                circle.reverse();
                return Some(circle);
            }
            if !before.contains_key(target) {
                before.insert(target, module);
                open.push_back(target);
            }
        }
    }
    None
}

/// A path as it is written, with the module in which it stands.
#[derive(Clone)]
struct Written {
    segments: Segments,
    scope: Segments,
}

/// An import as it is written.
struct Import {
    name: String,
    path: Written,
    /// Whether it is a re-export.
    public: bool,
}

/// Text of a module, in parts.
#[derive(Default)]
struct Text {
    children: BTreeSet<String>,
    imports: Vec<Import>,
    paths: Vec<Written>,
    /// Words that do not follow a `::`; those of imports excepted.
    words: BTreeSet<String>,
}

impl Module {
    /// Reads the module at a path.
    fn parse(tokens: &[String], path: &[String]) -> Self {
        let text = Text::read(tokens, path);
        let absolute = |written: &Written| text.absolute(written, path, 0);
        let used = text.imports.iter().filter(|i| !i.public || text.words.contains(&i.name));
        let paths = text.paths.iter().chain(used.map(|import| &import.path));
        let named = text.imports.iter().filter(|i| i.name != "*" && i.path.scope == path);
        Self {
            children: text.children.clone(),
            paths: paths.filter_map(absolute).collect(),
            imports: named.filter_map(|i| Some((i.name.clone(), absolute(&i.path)?))).collect(),
        }
    }
}

impl Text {
    fn read(tokens: &[String], path: &[String]) -> Self {
        let mut text = Self::default();
        let mut scope = path.to_vec();
        // Depth of braces, and those at which the modules begin that are written out.
        let (mut depth, mut inline) = (0, Vec::new());
        let mut i = 0;
        while i < tokens.len() {
            let at = |k: usize| tokens.get(k).map_or("", String::as_str);
            let before = if i == 0 { "" } else { at(i - 1) };
            match at(i) {
                "mod" if at(i + 2) == ";" => {
                    text.children.insert(at(i + 1).to_owned());
                    i += 3;
                }
                "mod" if at(i + 2) == "{" => {
                    scope.push(at(i + 1).to_owned());
                    inline.push(depth);
                    depth += 1;
                    i += 3;
                }
                "use" if at(i + 1) != "<" => {
                    let mut tree = Tree { tokens, next: i + 1, leaves: Vec::new() };
                    tree.read(&[]);
                    i = tree.next;
                    let public = before == "pub" || before == ")";
                    text.imports.extend(tree.leaves.into_iter().map(|Leaf { name, segments }| {
                        Import { name, path: Written { segments, scope: scope.clone() }, public }
                    }));
                }
                "{" => {
                    depth += 1;
                    i += 1;
                }
                "}" => {
                    depth -= 1;
                    if inline.last() == Some(&depth) {
                        inline.pop();
                        scope.pop();
                    }
                    i += 1;
                }
                "::" => i += 2,
                word => {
                    text.words.insert(word.to_owned());
                    let mut segments = vec![word.to_owned()];
                    i += 1;
                    while at(i) == "::" && is_name(at(i + 1)) {
                        segments.push(at(i + 1).to_owned());
                        i += 2;
                    }
                    // A macro is found by its name, wherever it is defined.
                    if segments.len() > 1 && at(i) != "!" {
                        text.paths.push(Written { segments, scope: scope.clone() });
                    }
                }
            }
        }
        text
    }

    /// Returns a path from the root of the crate; none if it leads elsewhere, or to an item of its
    /// own module by its bare name.
    fn absolute(&self, written: &Written, path: &[String], depth: usize) -> Option<Segments> {
        let Written { segments, scope } = written;
        let (first, rest) = segments.split_first()?;
        match first.as_str() {
            "crate" => Some(rest.to_vec()),
            "self" => self.absolute_in(scope, rest),
            "super" => self.absolute_in(scope.split_last()?.1, rest),
            name if scope == path && self.children.contains(name) => {
                Some([scope, &segments[..]].concat())
            }
            name => {
                let mut imports = self.imports.iter();
                let import = imports.find(|i| i.name == name && i.path.segments != *segments)?;
                let start =
                    (depth < 16).then(|| self.absolute(&import.path, path, depth + 1))??;
                Some([&start[..], rest].concat())
            }
        }
    }

    /// The same for what follows a `self` or a `super` that leads to a module.
    fn absolute_in(&self, module: &[String], rest: &[String]) -> Option<Segments> {
        match rest.split_first() {
            Some((first, rest)) if first == "super" => {
                self.absolute_in(module.split_last()?.1, rest)
            }
            _ => Some([module, rest].concat()),
        }
    }
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// A name that a `use` brings in.
struct Leaf {
    name: String,
    segments: Segments,
}

/// Reader of the tree of a `use`, whose tokens end with a semicolon.
struct Tree<'a> {
    tokens: &'a [String],
    next: usize,
    leaves: Vec<Leaf>,
}

impl Tree<'_> {
    /// Reads a branch behind a prefix, and the sign that ends it.
    fn read(&mut self, prefix: &[String]) {
        let mut segments = prefix.to_vec();
        let mut name = None;
        while let Some(token) = self.tokens.get(self.next) {
            self.next += 1;
            match token.as_str() {
                "::" => {}
                "{" => {
                    while self.tokens.get(self.next).is_some_and(|token| token != "}") {
                        self.read(&segments);
                        // The brace that ends the last branch ends the group too.
                        if self.tokens[self.next - 1] == "}" {
                            self.next -= 1;
                        }
                    }
                    self.next += 1;
                    segments.clear();
                }
                "," | "}" | ";" => break,
                "self" if !segments.is_empty() => {}
                "as" => {
                    name = self.tokens.get(self.next).cloned();
                    self.next += 1;
                }
                word => segments.push(word.to_owned()),
            }
        }
        if let Some(last) = segments.last() {
            let name = name.unwrap_or_else(|| last.clone());
            self.leaves.push(Leaf { name, segments });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the first circle of a crate with some modules.
    fn circle(files: &[(&str, &str)]) -> Option<String> {
        let text = |path: &Path| {
            let file = files.iter().find(|(file, _)| Path::new(file) == path);
            file.map(|(_, text)| (*text).to_owned())
        };
        Modules::from_files(Path::new("src/lib.rs"), &text).circles().into_iter().next()
    }

    const LIB: (&str, &str) = ("src/lib.rs", "mod a;\nmod b;\npub use a::A;\npub use b::B;");

    #[test]
    fn modules_that_use_each_other_are_a_circle() {
        let forth = ("src/a.rs", "use crate::b::{self, C};\npub struct A(b::B, C);");
        let back = ("src/b.rs", "pub struct B;\npub struct C(Vec<super::A>);");
        let found = circle(&[LIB, forth, back]);
        assert_eq!(
            found.as_deref(),
            Some("a uses b (`crate::b::B`), b uses a (`crate::A`)"),
            "{found:?}"
        );
        assert_eq!(circle(&[LIB, forth, ("src/b.rs", "pub struct B; pub struct C;")]), None);
    }

    #[test]
    fn reexports_are_followed_and_are_no_use() {
        let parent = ("src/b.rs", "mod c;\npub use c::{B, D as E};");
        let child = ("src/b/c.rs", "pub struct B; pub struct D;");
        let user = ("src/a.rs", "pub struct A(crate::b::E);");
        assert_eq!(circle(&[LIB, user, parent, child]), None);
        let back = ("src/b/c.rs", "use crate::A;\npub struct B(A); pub struct D;");
        let found = circle(&[LIB, user, parent, back]);
        assert_eq!(
            found.as_deref(),
            Some("a uses b::c (`crate::b::E`), b::c uses a (`crate::A`)"),
            "{found:?}"
        );
    }

    #[test]
    fn a_parent_that_uses_its_child_is_not_used_by_it() {
        let user = ("src/a.rs", "pub struct A;");
        let child = ("src/b/c.rs", "pub fn f(b: super::B) {}");
        let uses = ("src/b.rs", "mod c;\npub struct B;\nfn g(b: B) { c::f(b) }");
        let found = circle(&[LIB, user, uses, child]);
        assert_eq!(
            found.as_deref(),
            Some("b uses b::c (`crate::b::c::f`), b::c uses b (`crate::b::B`)")
        );
        let declares = ("src/b.rs", "mod c;\npub struct B;");
        assert_eq!(circle(&[LIB, user, declares, child]), None);
    }

    #[test]
    fn tests_comments_and_strings_are_not_read() {
        let text = "// crate::a::A\n/* crate::a /* */ ::A */\nconst S: &str = \"crate::a::A\\\"\";\n\
                    const R: &str = r#\"\" crate::a::A\"#;\nfn f<'a>(c: char) -> bool { c == '\"' }\n\
                    #[cfg(test)]\nmod tests { use crate::a::A; }\n\
                    #[cfg(test)]\nuse crate::a::{A};\npub struct B;";
        let user = ("src/a.rs", "pub struct A(crate::B);");
        assert_eq!(circle(&[LIB, user, ("src/b.rs", text)]), None);
        let found = circle(&[LIB, user, ("src/b.rs", &text.replace("B;", "B(crate::A);"))]);
        assert!(found.is_some(), "what follows them is read");
    }

    #[test]
    fn modules_written_out_in_a_file_are_part_of_it() {
        let user = ("src/a.rs", "pub struct A(crate::b::inner::C);");
        let text = "pub struct B;\npub mod inner { pub struct C(super::B); fn f() { super::super::A::g() } }";
        let found = circle(&[LIB, user, ("src/b.rs", text)]);
        assert_eq!(
            found.as_deref(),
            Some("a uses b (`crate::b::inner::C`), b uses a (`crate::A::g`)")
        );
    }
}
