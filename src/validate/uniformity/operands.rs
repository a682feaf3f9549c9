//! The expressions that an expression is made of.

use naga::{Expression, Handle, SampleLevel};

/// Those whose values decide that of `expression`, of an expression that has a value of its own.
pub(super) fn of(expression: &Expression) -> Vec<Handle<Expression>> {
    use Expression as E;
    let mut found = Vec::new();
    match expression {
        E::Compose { components, .. } => found.extend(components),
        E::Access { base, index } => found.extend([base, index]),
        E::AccessIndex { base, .. } => found.push(*base),
        E::Splat { value, .. } => found.push(*value),
        E::Swizzle { vector, .. } => found.push(*vector),
        E::ImageSample {
            coordinate,
            array_index,
            offset,
            level,
            depth_ref,
            ..
        } => {
            found.push(*coordinate);
            found.extend([array_index, offset, depth_ref].into_iter().flatten());
            match level {
                SampleLevel::Auto | SampleLevel::Zero => {}
                SampleLevel::Exact(level) | SampleLevel::Bias(level) => found.push(*level),
                SampleLevel::Gradient { x, y } => found.extend([x, y]),
            }
        }
        E::ImageLoad {
            coordinate,
            array_index,
            sample,
            level,
            ..
        } => {
            found.push(*coordinate);
            found.extend([array_index, sample, level].into_iter().flatten());
        }
        E::ImageQuery { query, .. } => {
            if let naga::ImageQuery::Size { level: Some(level) } = query {
                found.push(*level);
            }
        }
        E::Unary { expr, .. } | E::Derivative { expr, .. } | E::As { expr, .. } => {
            found.push(*expr);
        }
        E::Binary { left, right, .. } => found.extend([left, right]),
        E::Select {
            condition,
            accept,
            reject,
        } => found.extend([condition, accept, reject]),
        E::Relational { argument, .. } => found.push(*argument),
        E::Math {
            arg,
            arg1,
            arg2,
            arg3,
            ..
        } => {
            found.push(*arg);
            found.extend([arg1, arg2, arg3].into_iter().flatten());
        }
        E::CooperativeMultiplyAdd { a, b, c } => found.extend([a, b, c]),
        E::Literal(_)
        | E::Constant(_)
        | E::Override(_)
        | E::ZeroValue(_)
        | E::FunctionArgument(_)
        | E::GlobalVariable(_)
        | E::LocalVariable(_)
        | E::Load { .. }
        | E::CallResult(_)
        | E::AtomicResult { .. }
        | E::WorkGroupUniformLoadResult { .. }
        | E::ArrayLength(_)
        | E::RayQueryVertexPositions { .. }
        | E::RayQueryProceedResult
        | E::RayQueryGetIntersection { .. }
        | E::SubgroupBallotResult
        | E::SubgroupOperationResult { .. }
        | E::CooperativeLoad { .. } => {}
    }
    found
}
