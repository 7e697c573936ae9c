//! Generated Rust has no name that is bound and not used, and assigns no value that is not read:
//! the module of every spec compiles without warnings of its user's compiler.

use std::collections::HashMap;

use abbe_codegen::print;
use abbe_spec::Spec;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::closed_machines::{FOUR_BAR, TWO_ARMS, hexapod, some_errors};
use crate::readable_rust::{LEAVES, SPEC, expression, long_chain, shipped};

/// The tokens of a block, and where each name occurs in it.
struct Block {
    trees: Vec<TokenTree>,
    /// Tokens that have a name, and `true` for those that read it.
    places: HashMap<String, Vec<(usize, bool)>>,
}

impl Block {
    fn new(tokens: TokenStream) -> Self {
        let trees: Vec<TokenTree> = tokens.into_iter().collect();
        let mut places: HashMap<String, Vec<(usize, bool)>> = HashMap::new();
        for (k, tree) in trees.iter().enumerate() {
            match tree {
                TokenTree::Ident(name) => {
                    places.entry(name.to_string()).or_default().push((k, !is_assigned(&trees, k)));
                }
                TokenTree::Group(group) => {
                    for (name, inner) in Self::new(group.stream()).places {
                        let is_read = inner.iter().any(|(_, is_read)| *is_read);
                        places.entry(name).or_default().push((k, is_read));
                    }
                }
                _ => {}
            }
        }
        Self { trees, places }
    }

    fn is_read(&self, name: &str, from: usize) -> bool {
        self.places.get(name).is_some_and(|places| places.iter().any(|(k, is_read)| *k >= from && *is_read))
    }

    /// Returns `true` if the next statement that has a name assigns it without reading it.
    fn is_overwritten(&self, name: &str, from: usize) -> bool {
        let places = self.places.get(name).map_or(&[][..], |places| places);
        let mut behind = places.iter().filter(|(k, _)| *k >= from);
        let Some((first, false)) = behind.next().copied() else { return false };
        let in_value = |(k, _): &(usize, bool)| *k < self.end(first);
        is_assigned(&self.trees, first) && !behind.next().is_some_and(in_value)
    }

    /// Returns the end of the statement of a token.
    fn end(&self, from: usize) -> usize {
        let sign = self.trees[from..].iter().position(|tree| is_sign(tree, ';'));
        sign.map_or(self.trees.len(), |k| from + k)
    }

    /// Appends the names that are bound, counted or assigned and not read afterwards. `is_read`
    /// tells those that are read behind the block, or in the next iteration.
    fn unused(&self, is_read: &dyn Fn(&str) -> bool, found: &mut Vec<String>) {
        for (k, tree) in self.trees.iter().enumerate() {
            let rest = &self.trees[k + 1..];
            match tree {
                TokenTree::Group(group) => {
                    let block = Self::new(group.stream());
                    let is_loop = loop_head(&self.trees[..k]).is_some();
                    let later = |name: &str| {
                        is_read(name) || self.is_read(name, k + 1) || is_loop && block.is_read(name, 0)
                    };
                    block.unused(&later, found);
                }
                TokenTree::Ident(word) if word == "let" => {
                    let pattern = rest.split(|tree| is_sign(tree, '=')).next().unwrap();
                    let end = self.end(k);
                    found.extend(
                        names(pattern)
                            .into_iter()
                            .filter(|name| !self.is_read(name, end) || self.is_overwritten(name, end)),
                    );
                }
                TokenTree::Ident(word) if word == "for" => {
                    let body = k + 1 + rest.iter().position(is_block).unwrap_or(0);
                    let pattern = loop_head(&self.trees[..body]).into_iter().flat_map(names);
                    let TokenTree::Group(group) = &self.trees[body] else { continue };
                    let block = Self::new(group.stream());
                    found.extend(pattern.filter(|name| !block.is_read(name, 0)));
                }
                TokenTree::Ident(name) if is_assigned(&self.trees, k) => {
                    let (name, end) = (name.to_string(), self.end(k));
                    if !(self.is_read(&name, end) || is_read(&name)) || self.is_overwritten(&name, end) {
                        found.push(name);
                    }
                }
                _ => {}
            }
        }
    }
}

/// Returns the pattern of a `for` if these tokens end with its head.
fn loop_head(before: &[TokenTree]) -> Option<&[TokenTree]> {
    let is_word = |tree: &TokenTree, word: &str| matches!(tree, TokenTree::Ident(name) if name == word);
    let ends = |tree: &TokenTree| is_block(tree) || is_sign(tree, ';') || is_word(tree, "for");
    let begin = before.iter().rposition(ends).filter(|k| is_word(&before[*k], "for"))?;
    let head = &before[begin + 1..];
    head.iter().position(|tree| is_word(tree, "in")).map(|end| &head[..end])
}

fn is_block(tree: &TokenTree) -> bool {
    matches!(tree, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace)
}

fn is_sign(tree: &TokenTree, sign: char) -> bool {
    matches!(tree, TokenTree::Punct(punct) if punct.as_char() == sign)
}

/// Returns `true` if token k is a name that a statement assigns as a whole. An attribute such as
/// `doc = "…"` ends with its text.
fn is_assigned(trees: &[TokenTree], k: usize) -> bool {
    let begins = k == 0 || is_sign(&trees[k - 1], ';') || is_block(&trees[k - 1]);
    let sign = |k: usize| trees.get(k).is_some_and(|tree| is_sign(tree, '='));
    let is_attribute = k == 0 && trees.len() == 3 && matches!(trees[2], TokenTree::Literal(_));
    matches!(trees[k], TokenTree::Ident(_)) && begins && sign(k + 1) && !sign(k + 2) && !is_attribute
}

/// Returns the names that a pattern binds, without those that begin with an underscore.
fn names(pattern: &[TokenTree]) -> Vec<String> {
    let is_variable =
        |name: &String| name.starts_with(|first: char| first.is_ascii_lowercase()) && name != "mut";
    let block = Block::new(pattern.iter().cloned().collect());
    block.places.into_keys().filter(is_variable).collect()
}

/// Fails if the module of a spec has an unused name.
fn check(file: &str, spec: &str) {
    let spec = Spec::parse(file, spec).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut found = Vec::new();
    Block::new(print::rust(&spec).parse().unwrap()).unused(&|_| false, &mut found);
    assert!(found.is_empty(), "{file}: {found:?}");
}

#[test]
fn unused_names_are_recognized() {
    let found = |code: &str| {
        let mut found = Vec::new();
        Block::new(code.parse().unwrap()).unused(&|_| false, &mut found);
        found.sort_unstable();
        found
    };
    assert_eq!(found("let (a, b) = c; let [d, _] = e; f(a)"), ["b", "d"]);
    assert_eq!(found("for i in 0..3 { f(); } for k in 0..3 { g(k); } for _ in 0..3 {}"), ["i"]);
    assert_eq!(found("let mut a = [0; 3]; a = b; for i in 0..2 { let c = a; a = [c[i]; 3]; }"), ["a"]);
    assert_eq!(found("let mut a = 0; for i in 0..2 { a = i; } f(a); a = 1;"), ["a"]);
    assert_eq!(found("impl A for B { fn c(d: E) { d = 1; } }"), ["d"]);
}

#[test]
fn shipped_machines_use_every_name() {
    let others = [
        ("two_arms.toml", TWO_ARMS.to_owned()),
        ("hexapod.toml", hexapod(&some_errors(), "")),
        ("long.toml", long_chain()),
    ];
    let others = others.map(|(file, spec)| (file.to_owned(), spec));
    shipped().iter().chain(&others).for_each(|(file, spec)| check(file, spec));
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 30, failure_persistence: None, rng_seed: RngSeed::Fixed(53), ..ProptestConfig::default()
    })]

    #[test]
    fn random_chains_use_every_name(expression in expression(&LEAVES)) {
        let text = SPEC.replace("EXPRESSION", &format!("0.001*({expression})"));
        // Some are refused, such as `log(0.3 - 0.3)`.
        if Spec::parse("arm.toml", &text).is_ok() {
            check("arm.toml", &text);
        }
    }

    /// Errors move the passive variables, or leave them as they are.
    #[test]
    fn random_linkages_use_every_name(
        expression in expression(&["q1", "p1", "p2", "0.3", "2.5"]),
        frame in prop::sample::select(vec!["crank", "coupler", "rocker"]),
        component in prop::sample::select(vec!["e_y", "e_z", "e_p"]),
    ) {
        let source = format!(
            "[[source]]\nname = \"more\"\nclass = \"repeatable\"\nframe = \"{frame}\"\n\
             {component} = \"0.001{}*({expression})\"\n",
            if component == "e_p" { "" } else { " mm" }
        );
        let text = format!("{FOUR_BAR}\n{source}");
        if Spec::parse("four_bar.toml", &text).is_ok() {
            check("four_bar.toml", &text);
        }
    }
}
