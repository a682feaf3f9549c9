//! What a plan, or what is given with it, lacks.

use nightshade_renderer::rendergraph::RenderGraphError;

#[derive(Debug, thiserror::Error)]
pub enum HostError {
    #[error(
        "this wgpu does not know a name of the plan: {0}; compile the graph for another profile"
    )]
    Name(#[from] serde_json::Error),
    #[error("import '{0}' is missing, or has not {1} textures; give it as the plan describes it")]
    Import(String, usize),
    #[error("no pass writes '{0}', and nothing stands in for it; leave out the nodes that read it")]
    Unwritten(String),
    #[error("pass '{0}' has no pipeline and nobody draws it; make pipelines of this plan")]
    Pass(String),
    #[error("the render graph has a pass '{0}' already; give the node another name")]
    Taken(String),
    #[error(
        "map '{map}' would have {size:?} texels, but needs {smallest} along each side; give it more"
    )]
    TooSmall {
        map: String,
        size: [u32; 2],
        smallest: u32,
    },
    #[error(
        "a layer of map '{0}' has several regions, for which a plan has workgroups of one size alone; compile the graph"
    )]
    Regions(String),
    #[error("the plan has no {kind} '{name}'; it has {known}")]
    Unknown {
        kind: &'static str,
        name: String,
        known: String,
    },
    #[error("{path}: {source}; is the folder there?")]
    File {
        path: String,
        source: std::io::Error,
    },
    #[error("{0}")]
    Device(String),
    #[error(transparent)]
    RenderGraph(#[from] RenderGraphError),
    #[error(transparent)]
    Graph(#[from] moment_shadows_graph::GraphError),
    #[error(transparent)]
    Value(#[from] moment_shadows::ValueError),
}
