//! One function: what each value, variable and place in it depends on.

use naga::diagnostic_filter::Severity;
use naga::{
    AddressSpace, Binding, Block, BuiltIn, EntryPoint, Expression, Function, Handle, Module, Span,
    Statement, Type, TypeInner,
};

use super::super::flow::Behaviour;
use super::graph::{Graph, Label, Node};
use super::names::{barrier_name, gather_name};
use super::severity::{Rule, severity};
use super::summary::{Outcome, Requirement, Source, Summary};

/// The control flow after a statement.
struct Flow {
    control: Node,
    behaviour: Behaviour,
}

/// A statement that can be left from within: nodes for what variables hold where it is left, and, for a loop, where its next round
/// begins.
pub(super) struct Enclosing {
    after: Vec<Node>,
    continuing: Option<Vec<Node>>,
}

/// A function, with what its graph holds after the walk.
pub(super) struct Walked {
    pub(super) graph: Graph,
    /// What has to be uniform.
    pub(super) required: Vec<(Node, Requirement)>,
    /// What is never uniform.
    pub(super) differs: Node,
    /// What callers decide.
    pub(super) sources: Vec<(Source, Node)>,
    returned: Option<Node>,
    contents: Vec<Option<Node>>,
}

/// Follows a function from its start, its callees being known.
pub(super) fn walk(
    module: &Module,
    function: &Function,
    entry_point: Option<&EntryPoint>,
    callees: &[Summary],
) -> Walked {
    let mut graph = Graph::default();
    let differs = graph.node(&[]);
    let start = graph.node(&[]);
    let mut walk = Walk {
        module,
        function,
        callees,
        graph,
        differs,
        arguments: Vec::new(),
        values: vec![None; function.expressions.len()],
        variables: vec![start; function.local_variables.len()],
        pointed: Vec::new(),
        enclosing: Vec::new(),
        required: Vec::new(),
        returned: None,
        contents: Vec::new(),
    };
    let mut sources = walk.arguments(start, entry_point);
    if entry_point.is_none() {
        sources.push((Source::Call, start));
    }
    let flow = walk.block(&function.body, start);
    if flow.behaviour.next {
        walk.leave();
    }
    Walked {
        graph: walk.graph,
        required: walk.required,
        differs,
        sources,
        returned: walk.returned,
        contents: walk.contents,
    }
}

impl Walked {
    /// What callers have to know.
    pub(super) fn summary(&self) -> Summary {
        let mut summary = Summary::default();
        let reaches = self.sources.iter();
        let reaches: Vec<_> = reaches
            .map(|(source, node)| (*source, self.graph.reach(*node)))
            .collect();
        let differs = self.graph.reach(self.differs);
        for (node, requirement) in &self.required {
            // What is wrong here whatever is given is said here.
            if differs.holds(*node) {
                continue;
            }
            for (source, reach) in &reaches {
                if reach.holds(*node) {
                    summary.required.push((*source, requirement.clone()));
                }
            }
        }
        let outcome = |node: Node| Outcome {
            never_uniform: differs.holds(node),
            sources: reaches
                .iter()
                .filter(|(_, reach)| reach.holds(node))
                .map(|(source, _)| *source)
                .collect(),
        };
        summary.returned = self.returned.map(outcome).unwrap_or_default();
        summary.contents = self.contents.iter().map(|it| it.map(outcome)).collect();
        summary
    }
}

pub(super) struct Walk<'a> {
    pub(super) module: &'a Module,
    pub(super) function: &'a Function,
    pub(super) callees: &'a [Summary],
    pub(super) graph: Graph,
    pub(super) differs: Node,
    pub(super) arguments: Vec<Node>,
    /// For each expression that was evaluated, its value.
    pub(super) values: Vec<Option<Node>>,
    /// What local variables hold at this place, and after them what pointers among the arguments point at.
    pub(super) variables: Vec<Node>,
    /// For each argument that points into a function's memory, its place in `variables`.
    pub(super) pointed: Vec<Option<usize>>,
    pub(super) enclosing: Vec<Enclosing>,
    pub(super) required: Vec<(Node, Requirement)>,
    pub(super) returned: Option<Node>,
    /// For each argument that points into a function's memory, what is there when the function is left.
    pub(super) contents: Vec<Option<Node>>,
}

impl<'a> Walk<'a> {
    /// Makes the nodes of arguments; gives those that callers decide.
    fn arguments(&mut self, start: Node, entry_point: Option<&EntryPoint>) -> Vec<(Source, Node)> {
        let mut sources = Vec::new();
        for (index, argument) in self.function.arguments.iter().enumerate() {
            let expressions = self.function.expressions.iter();
            let mut found = expressions.filter(
                |(_, of)| matches!(of, Expression::FunctionArgument(i) if *i as usize == index),
            );
            let span = found.next().map_or(Span::UNDEFINED, |(handle, _)| {
                self.function.expressions.get_span(handle)
            });
            let node = match entry_point {
                Some(_) => self.input(argument.ty, argument.binding.as_ref(), start, span),
                None => {
                    let label = Label::Parameter(index as u32);
                    let node = self.graph.labelled(&[], label);
                    sources.push((Source::Argument(index), node));
                    node
                }
            };
            self.arguments.push(node);
            let inner = &self.module.types[argument.ty].inner;
            let is_pointer = matches!(
                inner,
                TypeInner::Pointer {
                    space: AddressSpace::Function,
                    ..
                } | TypeInner::ValuePointer {
                    space: AddressSpace::Function,
                    ..
                }
            );
            self.pointed.push(is_pointer.then(|| {
                let label = Label::Parameter(index as u32);
                let node = self.graph.labelled(&[], label);
                sources.push((Source::Contents(index), node));
                self.variables.push(node);
                self.variables.len() - 1
            }));
            let contents = is_pointer.then(|| self.graph.node(&[]));
            self.contents.push(contents);
        }
        sources
    }

    /// An input of an entry point. A struct is uniform only if all of its members are.
    fn input(
        &mut self,
        ty: Handle<Type>,
        binding: Option<&Binding>,
        start: Node,
        span: Span,
    ) -> Node {
        let bindings: Vec<&Binding> = match (binding, &self.module.types[ty].inner) {
            (Some(binding), _) => vec![binding],
            (None, TypeInner::Struct { members, .. }) => members
                .iter()
                .filter_map(|it| it.binding.as_ref())
                .collect(),
            (None, _) => Vec::new(),
        };
        let differing = bindings.into_iter().find(|binding| !is_uniform(binding));
        match differing {
            None => start,
            Some(Binding::BuiltIn(builtin)) => {
                let label = Label::BuiltIn(*builtin, span);
                self.graph.labelled(&[self.differs], label)
            }
            Some(Binding::Location { .. }) => {
                let label = Label::Input(span);
                self.graph.labelled(&[self.differs], label)
            }
        }
    }

    fn block(&mut self, block: &Block, start: Node) -> Flow {
        let mut flow = Flow {
            control: start,
            behaviour: Behaviour::NEXT,
        };
        for (statement, span) in block.span_iter() {
            // Nothing is executed after what leaves for good.
            if !flow.behaviour.next {
                break;
            }
            let after = self.statement(statement, *span, flow.control);
            flow.control = after.control;
            flow.behaviour.next = false;
            flow.behaviour = flow.behaviour.or(after.behaviour);
        }
        flow
    }

    fn statement(&mut self, statement: &Statement, span: Span, control: Node) -> Flow {
        let mut behaviour = Behaviour::NEXT;
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    let value = self.evaluate(handle, control);
                    self.set(handle, value);
                }
            }
            Statement::Block(block) => return self.block(block, control),
            Statement::If {
                condition,
                accept,
                reject,
            } => {
                let decided = self.condition(*condition, control);
                return self.branches([(decided, accept), (decided, reject)].into_iter(), control);
            }
            Statement::Switch { selector, cases } => {
                let decided = self.condition(*selector, control);
                let after = self.fresh_variables();
                self.enclosing.push(Enclosing {
                    after: after.clone(),
                    continuing: None,
                });
                // Of the selectors of one case naga makes cases that fall through to the last.
                let cases = cases.iter().filter(|case| !case.fall_through);
                let blocks = cases.map(|case| (decided, &case.body));
                let mut flow = self.branches(blocks, control);
                self.enclosing.pop();
                if flow.behaviour.breaks {
                    if flow.behaviour.next {
                        self.join(&after);
                    }
                    self.variables = after;
                    flow.behaviour.breaks = false;
                    flow.behaviour.next = true;
                }
                if flow.behaviour.only_next() {
                    flow.control = control;
                }
                return flow;
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => return self.looped(body, continuing, *break_if, control),
            Statement::Break => {
                if let Some(after) = self.enclosing.last().map(|it| it.after.clone()) {
                    self.join(&after);
                }
                behaviour = Behaviour::default();
                behaviour.breaks = true;
            }
            Statement::Continue => {
                let mut enclosing = self.enclosing.iter().rev();
                let next = enclosing.find_map(|it| it.continuing.clone());
                if let Some(next) = next {
                    self.join(&next);
                }
                behaviour = Behaviour::default();
                behaviour.continues = true;
            }
            Statement::Return { value } => {
                if let Some(value) = value {
                    let value = self.value(*value, control);
                    let returned = self.returned.unwrap_or_else(|| self.graph.node(&[]));
                    self.returned = Some(returned);
                    self.graph.depend(returned, value);
                }
                self.leave();
                behaviour = Behaviour::default();
                behaviour.returns = true;
            }
            Statement::Kill | Statement::MemoryBarrier(_) | Statement::ImageStore { .. } => {}
            Statement::ControlBarrier(barrier) => {
                self.require_uniform(control, barrier_name(*barrier), Rule::Always, span);
            }
            Statement::Store { pointer, value } => {
                let value = self.value(*value, control);
                self.store(*pointer, &[value], control);
            }
            Statement::Atomic { result, .. } => {
                if let Some(result) = result {
                    let value = self.graph.labelled(&[self.differs], Label::Result(span));
                    self.set(*result, value);
                }
            }
            Statement::ImageAtomic { .. } | Statement::CooperativeStore { .. } => {}
            Statement::WorkGroupUniformLoad { pointer, result } => {
                let by = "workgroupUniformLoad";
                self.require_uniform(control, by, Rule::Always, span);
                let place = self.place(*pointer, control);
                let index = self.graph.node(&place.indices);
                self.require(index, false, by, Rule::Always, span);
                self.set(*result, control);
            }
            Statement::Call {
                function,
                arguments,
                result,
            } => {
                let callees = self.callees;
                if let Some(callee) = callees.get(function.index()) {
                    self.call(callee, arguments, *result, control, span);
                }
            }
            Statement::RayQuery { fun, .. } => {
                if let naga::RayQueryFunction::Proceed { result } = fun {
                    let value = self.graph.labelled(&[self.differs], Label::Result(span));
                    self.set(*result, value);
                }
            }
            Statement::RayPipelineFunction(_) => {}
            Statement::SubgroupBallot { result, .. } => {
                self.subgroup(*result, None, "subgroupBallot", control, span);
            }
            Statement::SubgroupGather { mode, result, .. } => {
                let (by, index) = gather_name(*mode);
                self.subgroup(*result, index, by, control, span);
            }
            Statement::SubgroupCollectiveOperation { result, .. } => {
                self.subgroup(*result, None, "a subgroup operation", control, span);
            }
        }
        Flow { control, behaviour }
    }

    /// Blocks of which one is executed, each with the control flow in it.
    fn branches<'b>(
        &mut self,
        blocks: impl Iterator<Item = (Node, &'b Block)>,
        control: Node,
    ) -> Flow {
        let before = self.variables.clone();
        let mut behaviour = Behaviour::default();
        let mut ends = Vec::new();
        let mut merged: Option<Vec<Node>> = None;
        for (decided, block) in blocks {
            self.variables.clone_from(&before);
            let flow = self.block(block, decided);
            behaviour = behaviour.or(flow.behaviour);
            ends.push(flow.control);
            if flow.behaviour.next {
                let after = core::mem::take(&mut self.variables);
                merged = Some(match merged {
                    None => after,
                    Some(merged) => self.either(&merged, &after),
                });
            }
        }
        self.variables = merged.unwrap_or(before);
        let control = if behaviour.only_next() {
            control
        } else {
            self.graph.node(&ends)
        };
        Flow { control, behaviour }
    }

    /// What variables hold after one of two ways.
    fn either(&mut self, one: &[Node], other: &[Node]) -> Vec<Node> {
        let mut both = Vec::with_capacity(one.len());
        for (one, other) in one.iter().zip(other) {
            both.push(if one == other {
                *one
            } else {
                self.graph.node(&[*one, *other])
            });
        }
        both
    }

    fn looped(
        &mut self,
        body: &Block,
        continuing: &Block,
        break_if: Option<Handle<Expression>>,
        control: Node,
    ) -> Flow {
        let head = self.graph.node(&[control]);
        let round = self.fresh_variables();
        self.join(&round);
        let next = self.fresh_variables();
        let after = self.fresh_variables();
        self.variables.clone_from(&round);
        self.enclosing.push(Enclosing {
            after: after.clone(),
            continuing: Some(next.clone()),
        });
        let in_body = self.block(body, head);
        if in_body.behaviour.next {
            self.join(&next);
        }
        self.variables.clone_from(&next);
        let mut end = self.block(continuing, in_body.control).control;
        if let Some(condition) = break_if {
            end = self.condition(condition, end);
            self.join(&after);
        }
        self.join(&round);
        self.graph.depend(head, end);
        self.enclosing.pop();
        self.variables = after;
        let behaviour = Behaviour {
            next: in_body.behaviour.breaks || break_if.is_some(),
            returns: in_body.behaviour.returns,
            ..Behaviour::default()
        };
        let control = if behaviour.only_next() { control } else { head };
        Flow { control, behaviour }
    }

    /// A node for each variable that depends on nothing yet.
    fn fresh_variables(&mut self) -> Vec<Node> {
        let count = self.variables.len();
        (0..count).map(|_| self.graph.node(&[])).collect()
    }

    /// Says that variables may come to the place of `nodes` with what they hold here.
    fn join(&mut self, nodes: &[Node]) {
        for (node, held) in nodes.iter().zip(&self.variables) {
            self.graph.depend(*node, *held);
        }
    }

    /// The function is left here.
    fn leave(&mut self) {
        for (contents, variable) in self.contents.iter().zip(&self.pointed) {
            if let (Some(contents), Some(variable)) = (contents, variable) {
                self.graph.depend(*contents, self.variables[*variable]);
            }
        }
    }

    pub(super) fn set(&mut self, handle: Handle<Expression>, value: Node) {
        if let Some(place) = self.values.get_mut(handle.index()) {
            *place = Some(value);
        }
    }

    /// The control flow that a condition decides.
    fn condition(&mut self, condition: Handle<Expression>, control: Node) -> Node {
        let value = self.value(condition, control);
        let span = self.function.expressions.get_span(condition);
        self.graph.labelled(&[value], Label::Condition(span))
    }

    pub(super) fn require_uniform(
        &mut self,
        control: Node,
        by: &'static str,
        rule: Rule,
        span: Span,
    ) {
        self.require(control, true, by, rule, span);
    }

    pub(super) fn require(
        &mut self,
        node: Node,
        control_flow: bool,
        by: &'static str,
        rule: Rule,
        span: Span,
    ) {
        let severity = severity(self.module, self.function, rule);
        if severity == Severity::Off {
            return;
        }
        let requirement = Requirement {
            by,
            span,
            calls: Vec::new(),
            control_flow,
            severity,
        };
        self.required.push((node, requirement));
    }
}

/// Whether an input is the same for all invocations of a workgroup, or of a draw.
fn is_uniform(binding: &Binding) -> bool {
    use BuiltIn::{NumSubgroups, NumWorkGroups, WorkGroupId, WorkGroupSize};
    matches!(
        binding,
        Binding::BuiltIn(WorkGroupId | NumWorkGroups | WorkGroupSize | NumSubgroups)
    )
}
