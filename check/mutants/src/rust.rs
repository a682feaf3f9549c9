//! Faults in Rust.

use std::ops::Range;

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Block, Expr, ExprLit, Lit, Pat, ReturnType, Signature, Stmt, UnOp};

use crate::site::{ON, Site, hash, other_number};

/// The faults that can be planted in a file.
pub fn sites(file: &str, text: &str, seed: u64) -> Result<Vec<Site>, syn::Error> {
    let parsed = syn::parse_file(text)?;
    let mut finder = Finder {
        file,
        text,
        seed,
        sites: Vec::new(),
    };
    finder.visit_file(&parsed);
    Ok(finder.sites)
}

struct Finder<'a> {
    file: &'a str,
    text: &'a str,
    seed: u64,
    sites: Vec<Site>,
}

impl Finder<'_> {
    fn of(&self, node: &impl Spanned) -> (Range<usize>, &str) {
        let range = node.span().byte_range();
        (range.clone(), &self.text[range])
    }

    fn choice(&self, node: &impl Spanned) -> u64 {
        hash(
            &format!("{}:{}", self.file, node.span().byte_range().start),
            self.seed,
        )
    }

    fn plant(&mut self, range: Range<usize>, with: String, what: String) {
        let site = Site::new(self.file, self.text, range, with, what);
        self.sites.push(site);
    }

    /// `fault` in place of an expression.
    fn instead(&mut self, node: &impl Spanned, fault: String, what: String) {
        let (range, original) = self.of(node);
        let chosen = format!("if {ON} {{ {fault} }} else {{ {original} }}");
        // An arm that is a block has no comma after it.
        let with = match original.starts_with('{') {
            true => format!("{{ {chosen} }}"),
            false => format!("({chosen})"),
        };
        self.plant(range, with, what);
    }

    /// The part `part` of an expression becomes `other`.
    fn part(&mut self, node: &impl Spanned, part: &impl Spanned, other: &str) {
        let ((range, original), (at, was)) = (self.of(node), self.of(part));
        let (before, after) = (
            &original[..at.start - range.start],
            &original[at.end - range.start..],
        );
        let (fault, what) = (
            format!("{before}{other}{after}"),
            format!("`{was}` becomes `{other}`"),
        );
        self.instead(node, fault, what);
    }

    fn condition(&mut self, node: &Expr, can_hold: bool) {
        if has_let(node) {
            return;
        }
        let (range, original) = self.of(node);
        let (with, holds) = match self.choice(node) % 2 {
            0 if can_hold => (format!("({ON} || ({original}))"), "always"),
            _ => (format!("(!{ON} && ({original}))"), "never"),
        };
        let what = format!("the condition `{}` {holds} holds", one_line(original));
        self.plant(range, with, what);
    }

    fn function(&mut self, signature: &Signature, body: &Block) {
        if signature.constness.is_some() {
            return;
        }
        let result = match &signature.output {
            ReturnType::Default => Some(String::new()),
            ReturnType::Type(_, of) => {
                let of = self.of(of.as_ref()).1;
                let start = of.split('<').next().unwrap_or_default();
                match start {
                    "bool" => Some(if self.choice(body).is_multiple_of(2) {
                        "true"
                    } else {
                        "false"
                    }),
                    "Option" => Some("None"),
                    "Vec" => Some("Vec::new()"),
                    "String" => Some("String::new()"),
                    "f32" | "f64" => Some("0.0"),
                    "u8" | "u16" | "u32" | "u64" | "usize" | "i32" => Some("0"),
                    "Result" if of.starts_with("Result<(),") => Some("Ok(())"),
                    _ => None,
                }
                .map(|value| format!(" {value}"))
            }
        };
        if let Some(result) = result
            && !body.stmts.is_empty()
        {
            let at = body.span().byte_range().start + 1;
            let what = format!("`{}` returns{result} at once", signature.ident);
            self.plant(at..at, format!("if {ON} {{ return{result}; }}"), what);
        }
        self.visit_block(body);
    }
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn has_let(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(of) => has_let(&of.left) || has_let(&of.right),
        _ => false,
    }
}

fn is_of_tests(attributes: &[syn::Attribute]) -> bool {
    let is_test = |it: &syn::Attribute| {
        it.path().is_ident("cfg")
            && it
                .meta
                .require_list()
                .is_ok_and(|of| of.tokens.to_string() == "test")
    };
    attributes.iter().any(is_test)
}

/// Whether a pattern gives names to nothing.
fn is_plain(pattern: &Pat) -> bool {
    match pattern {
        Pat::Ident(of) => {
            of.subpat.is_none() && of.ident.to_string().starts_with(char::is_uppercase)
        }
        Pat::Lit(_) | Pat::Path(_) | Pat::Wild(_) | Pat::Rest(_) | Pat::Range(_) => true,
        Pat::Or(of) => of.cases.iter().all(is_plain),
        Pat::Paren(of) => is_plain(&of.pat),
        Pat::Reference(of) => is_plain(&of.pat),
        Pat::Tuple(of) => of.elems.iter().all(is_plain),
        Pat::TupleStruct(of) => of.elems.iter().all(is_plain),
        Pat::Struct(of) => of.fields.iter().all(|field| is_plain(&field.pat)),
        _ => false,
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    // What is no code that runs, or cannot choose.
    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_item_enum(&mut self, _: &'ast syn::ItemEnum) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
    fn visit_pat(&mut self, _: &'ast Pat) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_generic_argument(&mut self, _: &'ast syn::GenericArgument) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}
    fn visit_expr_repeat(&mut self, node: &'ast syn::ExprRepeat) {
        self.visit_expr(&node.expr);
    }

    fn visit_item_mod(&mut self, node: &'ast syn::ItemMod) {
        if !is_of_tests(&node.attrs) {
            visit::visit_item_mod(self, node);
        }
    }

    fn visit_item_fn(&mut self, node: &'ast syn::ItemFn) {
        self.function(&node.sig, &node.block);
    }

    fn visit_impl_item_fn(&mut self, node: &'ast syn::ImplItemFn) {
        self.function(&node.sig, &node.block);
    }

    fn visit_trait_item_fn(&mut self, node: &'ast syn::TraitItemFn) {
        if let Some(body) = &node.default {
            self.function(&node.sig, body);
        }
    }

    fn visit_stmt(&mut self, node: &'ast Stmt) {
        if let Stmt::Expr(expression, Some(_)) = node {
            let called = match expression {
                Expr::Try(of) => of.expr.as_ref(),
                other => other,
            };
            if matches!(called, Expr::MethodCall(_) | Expr::Call(_)) {
                let (range, original) = self.of(node);
                let (with, what) = (
                    format!("if !{ON} {{ {original} }}"),
                    format!("`{}` is left out", one_line(original)),
                );
                self.plant(range, with, what);
            }
        }
        visit::visit_stmt(self, node);
    }

    fn visit_expr(&mut self, node: &'ast Expr) {
        let choice = self.choice(node);
        let either =
            |a: &'static str, b: &'static str| if choice.is_multiple_of(2) { a } else { b };
        match node {
            Expr::Binary(of) if !has_let(node) => {
                let other = match of.op {
                    BinOp::Add(_) => "-",
                    BinOp::Sub(_) => "+",
                    BinOp::Mul(_) => either("/", "+"),
                    BinOp::Div(_) | BinOp::Rem(_) => "*",
                    BinOp::And(_) => "||",
                    BinOp::Or(_) => "&&",
                    BinOp::BitAnd(_) => "|",
                    BinOp::BitOr(_) | BinOp::BitXor(_) => "&",
                    BinOp::Shl(_) => ">>",
                    BinOp::Shr(_) => "<<",
                    BinOp::Eq(_) => "!=",
                    BinOp::Ne(_) => "==",
                    BinOp::Lt(_) => either("<=", ">="),
                    BinOp::Le(_) => either("<", ">"),
                    BinOp::Gt(_) => either(">=", "<="),
                    BinOp::Ge(_) => either(">", "<"),
                    BinOp::AddAssign(_) => "-=",
                    BinOp::SubAssign(_) => "+=",
                    BinOp::MulAssign(_) => "/=",
                    BinOp::DivAssign(_) => "*=",
                    BinOp::BitOrAssign(_) => "&=",
                    BinOp::BitAndAssign(_) => "|=",
                    _ => "",
                };
                if !other.is_empty() {
                    self.part(node, &of.op, other);
                }
            }
            Expr::Unary(of) if matches!(of.op, UnOp::Not(_) | UnOp::Neg(_)) => {
                let fault = self.of(of.expr.as_ref()).1.to_owned();
                let what = format!("`{}` loses its sign", one_line(self.of(node).1));
                self.instead(node, fault, what);
            }
            Expr::Lit(ExprLit { lit, .. }) => {
                let (_, original) = self.of(node);
                let other = match lit {
                    Lit::Int(_) | Lit::Float(_) => other_number(original, choice),
                    Lit::Bool(of) => Some((!of.value).to_string()),
                    _ => None,
                };
                if let Some(other) = other {
                    let what = format!("`{original}` becomes `{other}`");
                    self.instead(node, other, what);
                }
            }
            Expr::MethodCall(of) => {
                let other = match of.method.to_string().as_str() {
                    "min" => "max",
                    "max" => "min",
                    "any" => "all",
                    "all" => "any",
                    "floor" => "ceil",
                    "ceil" => "floor",
                    "sin" => "cos",
                    "cos" => "sin",
                    "first" => "last",
                    "last" => "first",
                    "is_some" => "is_none",
                    "is_none" => "is_some",
                    "is_ok" => "is_err",
                    "is_err" => "is_ok",
                    "starts_with" => "ends_with",
                    "ends_with" => "starts_with",
                    "is_some_and" => "is_none_or",
                    "is_none_or" => "is_some_and",
                    _ => "",
                };
                if !other.is_empty() {
                    self.part(node, &of.method, other);
                }
            }
            Expr::If(of) => self.condition(&of.cond, true),
            Expr::While(of) => self.condition(&of.cond, false),
            Expr::Match(of) => {
                for pair in of.arms.windows(2) {
                    if let [arm, next] = pair
                        && is_plain(&arm.pat)
                        && is_plain(&next.pat)
                    {
                        let fault = self.of(next.body.as_ref()).1.to_owned();
                        let (pattern, of) = (self.of(&arm.pat).1, self.of(&next.pat).1);
                        let what =
                            format!("`{}` is taken for `{}`", one_line(pattern), one_line(of));
                        self.instead(arm.body.as_ref(), fault, what);
                    }
                }
                for arm in &of.arms {
                    if let Some((_, guard)) = &arm.guard {
                        self.condition(guard, true);
                    }
                }
            }
            _ => {}
        }
        visit::visit_expr(self, node);
    }
}
