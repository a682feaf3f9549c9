//! Every statement of a function, whatever it stands in.

use naga::{Block, Span, Statement};

/// Calls `visit` with each statement of a block and of the blocks in it, and where it stands.
pub(super) fn each<'a>(block: &'a Block, visit: &mut impl FnMut(&'a Statement, Span)) {
    for (statement, span) in block.span_iter() {
        visit(statement, *span);
        match statement {
            Statement::Block(inner) => each(inner, visit),
            Statement::If { accept, reject, .. } => {
                each(accept, visit);
                each(reject, visit);
            }
            Statement::Switch { cases, .. } => {
                for case in cases {
                    each(&case.body, visit);
                }
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                each(body, visit);
                each(continuing, visit);
            }
            _ => {}
        }
    }
}
