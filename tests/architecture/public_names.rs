//! Public names of a library: what its root exports, with public methods, fields and variants, read
//! from the sources by `syn`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use syn::{Attribute, Fields, ImplItem, Item, ItemImpl, TraitItem, Type, UseTree, Visibility};

/// Path of a module below the root of its crate.
type ModulePath = Vec<String>;

/// Modules of a crate, and the members of its types.
pub struct Library {
    modules: BTreeMap<ModulePath, Vec<Item>>,
    /// Public methods and constants of each type, by the module and the name of the type.
    members: BTreeMap<(ModulePath, String), BTreeSet<String>>,
}

impl Library {
    /// Reads the crate whose root is the file `root`. Modules of tests are left out.
    pub fn read(root: &Path) -> Self {
        let mut library = Self { modules: BTreeMap::new(), members: BTreeMap::new() };
        let folder = root.parent().expect("a root is in a folder");
        library.add(Vec::new(), items_of(root), folder);

        let mut members: BTreeMap<_, BTreeSet<String>> = BTreeMap::new();
        for (module, items) in &library.modules {
            for item in items {
                let Item::Impl(block) = item else { continue };
                if let Some(owner) = library.owner(module, block) {
                    members.entry(owner).or_default().extend(public_members(block));
                }
            }
        }
        library.members = members;
        library
    }

    /// Adds the module `path` with `items`, whose submodules are in `folder`.
    fn add(&mut self, path: ModulePath, items: Vec<Item>, folder: &Path) {
        for item in &items {
            let Item::Mod(module) = item else { continue };
            if is_test(&module.attrs) {
                continue;
            }
            let name = module.ident.to_string();
            let below = [&path[..], std::slice::from_ref(&name)].concat();
            let content = match &module.content {
                Some((_, items)) => items.clone(),
                None => items_of(&file_of(&module.attrs, folder, &name)),
            };
            self.add(below, content, &folder.join(&name));
        }
        self.modules.insert(path, items);
    }

    /// Returns the module and the name of the type to which `block`, in `module`, adds methods.
    fn owner(&self, module: &ModulePath, block: &ItemImpl) -> Option<(ModulePath, String)> {
        let Type::Path(path) = &*block.self_ty else { return None };
        let written: Vec<String> =
            path.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        if block.trait_.is_some() {
            return None;
        }
        self.find(module, &written, &mut BTreeSet::new())
    }

    /// Returns the module and the name of the item that the path `written` means in `module`.
    /// `seen` are the questions that are being answered, of which imports may form a circle.
    fn find(
        &self,
        module: &ModulePath,
        written: &[String],
        seen: &mut BTreeSet<(ModulePath, Vec<String>)>,
    ) -> Option<(ModulePath, String)> {
        if !seen.insert((module.clone(), written.to_vec())) {
            return None;
        }
        let (first, rest) = written.split_first()?;
        let from = match first.as_str() {
            "crate" => Vec::new(),
            "self" => module.clone(),
            "super" => module.split_last()?.1.to_vec(),
            _ => return self.find_named(module, first, rest, seen),
        };
        self.find(&from, rest, seen)
    }

    /// Returns what [`Library::find`] returns, for a path that begins with the name `first`.
    fn find_named(
        &self,
        module: &ModulePath,
        first: &String,
        rest: &[String],
        seen: &mut BTreeSet<(ModulePath, Vec<String>)>,
    ) -> Option<(ModulePath, String)> {
        let items = self.modules.get(module)?;
        let mut names = items.iter().filter_map(kind_and_name);
        if rest.is_empty() && names.any(|(_, name, _)| name == *first) {
            return Some((module.clone(), first.clone()));
        }
        let below = [&module[..], std::slice::from_ref(first)].concat();
        if self.modules.contains_key(&below) {
            return if rest.is_empty() {
                Some((module.clone(), first.clone()))
            } else {
                self.find(&below, rest, seen)
            };
        }
        for item in items {
            let Item::Use(import) = item else { continue };
            for (path, name) in imports(&import.tree) {
                if name == *first {
                    return self.find(module, &[&path[..], rest].concat(), seen);
                }
                if name == "*" {
                    let path = [&path[..], std::slice::from_ref(first), rest].concat();
                    if let Some(found) = self.find(module, &path, seen) {
                        return Some(found);
                    }
                }
            }
        }
        None
    }

    /// Returns the public names, a line each: the path from the root, and what the name is.
    pub fn public_names(&self) -> BTreeSet<String> {
        let mut names = BTreeSet::new();
        self.list(&Vec::new(), "", &mut names);
        names
    }

    /// Adds the public names of `module` to `names`, each after `prefix`.
    fn list(&self, module: &ModulePath, prefix: &str, names: &mut BTreeSet<String>) {
        for item in self.modules.get(module).into_iter().flatten() {
            if let Item::Use(import) = item {
                if !matches!(import.vis, Visibility::Public(_)) {
                    continue;
                }
                for (path, name) in imports(&import.tree) {
                    match self.find(module, &path, &mut BTreeSet::new()) {
                        Some((owner, item)) => {
                            self.list_item(&owner, &item, &format!("{prefix}{name}"), names);
                        }
                        None => {
                            names.insert(format!("{prefix}{name}  from {}", path.join("::")));
                        }
                    }
                }
            } else if let Some((_, name, true)) = kind_and_name(item) {
                self.list_item(module, &name, &format!("{prefix}{name}"), names);
            }
        }
    }

    /// Adds the item `name` of `module`, which is public as `path`, with its members to `names`.
    fn list_item(&self, module: &ModulePath, name: &str, path: &str, names: &mut BTreeSet<String>) {
        let items = self.modules.get(module).into_iter().flatten();
        let named: Vec<(&str, bool, &Item)> = items
            .filter_map(|item| {
                let (kind, known, is_public) = kind_and_name(item)?;
                (known == name).then_some((kind, is_public, item))
            })
            .collect();

        // A function and a private module may share a name. A private module that is exported by
        // `pub use` has no public item beside it.
        let has_public = named.iter().any(|(_, is_public, _)| *is_public);
        for (kind, _, item) in named.into_iter().filter(|named| named.1 || !has_public) {
            names.insert(format!("{path}  {kind}"));
            names.extend(parts(item).into_iter().map(|part| format!("{path}{part}")));
            if kind == "mod" {
                let below = [&module[..], &[name.to_owned()]].concat();
                self.list(&below, &format!("{path}::"), names);
            }
        }
        let members = self.members.get(&(module.clone(), name.to_owned()));
        names.extend(members.into_iter().flatten().map(|member| format!("{path}::{member}")));
    }
}

/// Returns the items of the source `file`.
fn items_of(file: &Path) -> Vec<Item> {
    let text = std::fs::read_to_string(file)
        .unwrap_or_else(|error| panic!("{} cannot be read: {error}", file.display()));
    let parsed = syn::parse_file(&text);
    parsed.unwrap_or_else(|error| panic!("{}: {error}", file.display())).items
}

/// Returns the file of the module `name` of a module whose submodules are in `folder`.
fn file_of(attributes: &[Attribute], folder: &Path, name: &str) -> PathBuf {
    let stated = attributes.iter().find_map(|attribute| match &attribute.meta {
        syn::Meta::NameValue(pair) if pair.path.is_ident("path") => match &pair.value {
            syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) => Some(text.value()),
            _ => None,
        },
        _ => None,
    });
    match stated {
        Some(path) => folder.join(path),
        None => folder.join(format!("{name}.rs")),
    }
}

/// Returns whether an item with these `attributes` is compiled for tests only.
fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        syn::Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        _ => false,
    })
}

/// Returns what `item` is, its name, and whether its module makes it public.
fn kind_and_name(item: &Item) -> Option<(&'static str, String, bool)> {
    let (kind, name, visibility) = match item {
        Item::Const(item) => ("const", &item.ident, &item.vis),
        Item::Static(item) => ("static", &item.ident, &item.vis),
        Item::Fn(item) => ("fn", &item.sig.ident, &item.vis),
        Item::Struct(item) => ("struct", &item.ident, &item.vis),
        Item::Enum(item) => ("enum", &item.ident, &item.vis),
        Item::Union(item) => ("union", &item.ident, &item.vis),
        Item::Type(item) => ("type", &item.ident, &item.vis),
        Item::Trait(item) => ("trait", &item.ident, &item.vis),
        Item::Mod(item) if !is_test(&item.attrs) => ("mod", &item.ident, &item.vis),
        _ => return None,
    };
    Some((kind, name.to_string(), matches!(visibility, Visibility::Public(_))))
}

/// Returns the public fields, the variants, or the items of a trait, each with what joins it to the
/// name of `item`.
fn parts(item: &Item) -> Vec<String> {
    let fields = |fields: &Fields| -> Vec<String> {
        let public = fields.iter().filter(|field| matches!(field.vis, Visibility::Public(_)));
        public.filter_map(|field| Some(format!(".{}  field", field.ident.as_ref()?))).collect()
    };
    match item {
        Item::Struct(item) => fields(&item.fields),
        Item::Enum(item) => {
            let variants = item.variants.iter().flat_map(|variant| {
                let name = &variant.ident;
                let named = variant.fields.iter().filter_map(|field| field.ident.as_ref());
                let fields = named.map(move |field| format!("::{name}.{field}  field"));
                fields.chain([format!("::{name}  variant")])
            });
            variants.collect()
        }
        Item::Trait(item) => item.items.iter().filter_map(trait_part).collect(),
        _ => Vec::new(),
    }
}

/// Returns the name of a trait's `item`, with what it is.
fn trait_part(item: &TraitItem) -> Option<String> {
    Some(match item {
        TraitItem::Fn(item) => format!("::{}  fn", item.sig.ident),
        TraitItem::Const(item) => format!("::{}  const", item.ident),
        TraitItem::Type(item) => format!("::{}  type", item.ident),
        _ => return None,
    })
}

/// Returns the public methods and constants of `block`, each with what it is.
fn public_members(block: &ItemImpl) -> Vec<String> {
    let members = block.items.iter().filter_map(|item| match item {
        ImplItem::Fn(item) if matches!(item.vis, Visibility::Public(_)) => {
            Some(format!("{}  fn", item.sig.ident))
        }
        ImplItem::Const(item) if matches!(item.vis, Visibility::Public(_)) => {
            Some(format!("{}  const", item.ident))
        }
        _ => None,
    });
    members.collect()
}

/// Returns the paths that `tree` imports, each with the name that it has here.
fn imports(tree: &UseTree) -> Vec<(Vec<String>, String)> {
    match tree {
        UseTree::Path(path) => {
            let first = path.ident.to_string();
            let below = imports(&path.tree).into_iter();
            below
                .map(|(rest, name)| {
                    // `a::{self}` imports `a` under its name.
                    let name = if name == "self" { first.clone() } else { name };
                    let rest = rest.into_iter().filter(|part| part != "self");
                    ([first.clone()].into_iter().chain(rest).collect(), name)
                })
                .collect()
        }
        UseTree::Name(name) => vec![(vec![name.ident.to_string()], name.ident.to_string())],
        UseTree::Rename(rename) => {
            vec![(vec![rename.ident.to_string()], rename.rename.to_string())]
        }
        UseTree::Glob(_) => vec![(Vec::new(), "*".to_owned())],
        UseTree::Group(group) => group.items.iter().flat_map(imports).collect(),
    }
}
