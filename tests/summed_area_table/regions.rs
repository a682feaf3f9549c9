//! Tables of atlases.
