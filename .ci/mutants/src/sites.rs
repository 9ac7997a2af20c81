//! Where the mutants of a file stand in it: each place of cargo-mutants' list is found again in the
//! syntax tree, which tells the operands.

use std::collections::BTreeMap;
use std::ops::Range;

use syn::spanned::Spanned;
use syn::visit::{self, Visit};

use crate::mutant::Mutant;

/// How a place is rewritten so that it holds its mutants; ranges are bytes of the file.
pub enum Form {
    /// An early return before the first statement.
    Body,
    /// A body that returns an iterator of a type without a name.
    Iterator,
    Arithmetic(Range<usize>, Range<usize>),
    Comparison(Range<usize>, Range<usize>),
    /// `&&`, or `||` where the flag is false.
    Logical(Range<usize>, Range<usize>, bool),
    Assignment(Range<usize>, Range<usize>),
    Unary(Range<usize>),
    /// An arm without a guard; its guard begins where the pattern ends.
    Arm,
    /// An arm with this guard, which may hold a `let`.
    GuardedArm(bool),
    Guard,
    /// A field of the struct that `path` names, beside the rest of `base`.
    Field {
        path: String,
        base: Range<usize>,
        value: Range<usize>,
        is_short: bool,
    },
}

/// A place of a file that has mutants, numbered from `first`.
pub struct Site {
    pub first: usize,
    pub count: usize,
    pub range: Range<usize>,
    /// As it is written in the file: the operator.
    pub original: String,
    pub form: Form,
}

/// What a file holds: its sites from the outermost inwards, and its mutants in constants, which are
/// computed by the compiler.
#[derive(Default)]
pub struct Found {
    pub sites: Vec<Site>,
    pub constant: Vec<usize>,
    /// Arms without which a match does not hold every case, and operators between conditions that
    /// bind names.
    pub unviable: Vec<usize>,
}

/// Finds the places of `mutants`, which are all in the file of this text.
pub fn find(text: &str, mutants: &[&Mutant]) -> syn::Result<Found> {
    let file = syn::parse_file(text)?;
    let mut wanted: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for mutant in mutants {
        wanted.entry(mutant.place()).or_default().push(mutant.id);
    }
    let mut finder = Finder { wanted, in_constant: false, found: Found::default() };
    finder.visit_file(&file);
    let mut found = finder.found;
    found.constant.extend(mutants.iter().filter(|m| m.function.is_none()).map(|m| m.id));
    found.sites.sort_by_key(|site| (site.range.start, usize::MAX - site.range.end));
    Ok(found)
}

struct Finder {
    wanted: BTreeMap<(String, usize, usize), Vec<usize>>,
    in_constant: bool,
    found: Found,
}

fn range(of: &impl Spanned) -> Range<usize> {
    of.span().byte_range()
}

impl Finder {
    /// Returns the mutants of `genre` at the start of `at`, for which the list is done with.
    fn take(&mut self, genre: &str, at: &impl Spanned) -> Vec<usize> {
        let start = at.span().start();
        let place = (genre.to_owned(), start.line, start.column + 1);
        self.wanted.remove(&place).unwrap_or_default()
    }

    fn leave_out(&mut self, genre: &str, at: &impl Spanned) {
        let ids = self.take(genre, at);
        self.found.unviable.extend(ids);
    }

    /// Adds a site where the list has mutants of `genre` at the start of `at`.
    fn add(&mut self, genre: &str, at: &impl Spanned, range: Range<usize>, form: Form) {
        let ids = self.take(genre, at);
        if ids.is_empty() {
            return;
        }
        if self.in_constant {
            self.found.constant.extend(ids);
            return;
        }
        let original = at.span().source_text().unwrap_or_default();
        self.found.sites.push(Site { first: ids[0], count: ids.len(), range, original, form });
    }

    fn body(&mut self, signature: &syn::Signature, block: &syn::Block) {
        let (Some(first), Some(last)) = (block.stmts.first(), block.stmts.last()) else { return };
        let (start, end) = (range(first).start, range(last).end);
        let is_opaque = matches!(&signature.output,
            syn::ReturnType::Type(_, of) if matches!(**of, syn::Type::ImplTrait(_)));
        if is_opaque {
            self.add("FnValue", first, start..end, Form::Iterator);
        } else {
            let inside = block.brace_token.span.open().byte_range().end;
            self.add("FnValue", first, inside..inside, Form::Body);
        }
    }

    /// Visits what the compiler computes.
    fn constant(&mut self, visit: impl FnOnce(&mut Self)) {
        let outer = std::mem::replace(&mut self.in_constant, true);
        visit(self);
        self.in_constant = outer;
    }

    fn function(&mut self, signature: &syn::Signature, visit: impl FnOnce(&mut Self)) {
        if signature.constness.is_some() {
            self.constant(visit);
        } else {
            visit(self);
        }
    }
}

/// Whether a condition binds names by `let`.
fn binds(condition: &syn::Expr) -> bool {
    match condition {
        syn::Expr::Let(_) => true,
        syn::Expr::Binary(binary) => binds(&binary.left) || binds(&binary.right),
        _ => false,
    }
}

fn form(binary: &syn::ExprBinary) -> Form {
    use syn::BinOp::*;
    let (left, right) = (range(&binary.left), range(&binary.right));
    match binary.op {
        And(_) | Or(_) => Form::Logical(left, right, matches!(binary.op, And(_))),
        Eq(_) | Ne(_) | Lt(_) | Le(_) | Gt(_) | Ge(_) => Form::Comparison(left, right),
        Add(_) | Sub(_) | Mul(_) | Div(_) | Rem(_) | BitXor(_) | BitAnd(_) | BitOr(_) | Shl(_)
        | Shr(_) => Form::Arithmetic(left, right),
        _ => Form::Assignment(left, right),
    }
}

impl<'a> Visit<'a> for Finder {
    fn visit_item_fn(&mut self, item: &'a syn::ItemFn) {
        self.function(&item.sig, |finder| {
            finder.body(&item.sig, &item.block);
            visit::visit_item_fn(finder, item);
        });
    }

    fn visit_impl_item_fn(&mut self, item: &'a syn::ImplItemFn) {
        self.function(&item.sig, |finder| {
            finder.body(&item.sig, &item.block);
            visit::visit_impl_item_fn(finder, item);
        });
    }

    fn visit_trait_item_fn(&mut self, item: &'a syn::TraitItemFn) {
        self.function(&item.sig, |finder| {
            if let Some(block) = &item.default {
                finder.body(&item.sig, block);
            }
            visit::visit_trait_item_fn(finder, item);
        });
    }

    fn visit_expr_binary(&mut self, binary: &'a syn::ExprBinary) {
        if binds(&binary.left) || binds(&binary.right) {
            self.leave_out("BinaryOperator", &binary.op);
        } else {
            let form = form(binary);
            self.add("BinaryOperator", &binary.op, range(binary), form);
        }
        visit::visit_expr_binary(self, binary);
    }

    fn visit_expr_unary(&mut self, unary: &'a syn::ExprUnary) {
        self.add("UnaryOperator", &unary.op, range(unary), Form::Unary(range(&unary.expr)));
        visit::visit_expr_unary(self, unary);
    }

    fn visit_expr_match(&mut self, of: &'a syn::ExprMatch) {
        // A constant or a variant begins with a capital letter, a binding does not.
        let holds_all = |arm: &syn::Arm| match &arm.pat {
            _ if arm.guard.is_some() => false,
            syn::Pat::Ident(name) => name.ident.to_string().starts_with(char::is_lowercase),
            other => matches!(other, syn::Pat::Wild(_)),
        };
        for arm in of.arms.iter().filter(|arm| arm.guard.is_none()) {
            if !of.arms.iter().any(|other| holds_all(other) && !std::ptr::eq(arm, other)) {
                self.leave_out("MatchArm", arm);
            }
        }
        visit::visit_expr_match(self, of);
    }

    fn visit_arm(&mut self, arm: &'a syn::Arm) {
        if let Some((_, guard)) = &arm.guard {
            let at = range(&**guard);
            self.add("MatchArm", arm, at.clone(), Form::GuardedArm(binds(guard)));
            if !binds(guard) {
                self.add("MatchArmGuard", &**guard, at, Form::Guard);
            }
        } else {
            let end = range(&arm.pat).end;
            self.add("MatchArm", arm, end..end, Form::Arm);
        }
        visit::visit_arm(self, arm);
    }

    fn visit_expr_struct(&mut self, of: &'a syn::ExprStruct) {
        if let Some(base) = &of.rest {
            for field in &of.fields {
                let path = of.path.span().source_text().unwrap_or_default();
                let (base, value) = (range(&**base), range(&field.expr));
                let is_short = field.colon_token.is_none();
                let form = Form::Field { path, base, value, is_short };
                self.add("StructField", field, range(field), form);
            }
        }
        visit::visit_expr_struct(self, of);
    }

    fn visit_item_const(&mut self, item: &'a syn::ItemConst) {
        self.constant(|finder| visit::visit_item_const(finder, item));
    }

    fn visit_item_static(&mut self, item: &'a syn::ItemStatic) {
        self.constant(|finder| visit::visit_item_static(finder, item));
    }

    fn visit_impl_item_const(&mut self, item: &'a syn::ImplItemConst) {
        self.constant(|finder| visit::visit_impl_item_const(finder, item));
    }

    fn visit_trait_item_const(&mut self, item: &'a syn::TraitItemConst) {
        self.constant(|finder| visit::visit_trait_item_const(finder, item));
    }

    fn visit_expr_repeat(&mut self, repeat: &'a syn::ExprRepeat) {
        self.visit_expr(&repeat.expr);
        self.constant(|finder| finder.visit_expr(&repeat.len));
    }

    fn visit_type(&mut self, of: &'a syn::Type) {
        self.constant(|finder| visit::visit_type(finder, of));
    }

    fn visit_pat(&mut self, pattern: &'a syn::Pat) {
        self.constant(|finder| visit::visit_pat(finder, pattern));
    }
}
