//! The error over all surfaces that a light's rays meet: the instrument itself, and whether it moves as theory says when
//! something is made better or worse.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod choices;
mod contact_shadows;
mod contacts;
mod device;
mod figures;
mod fitted;
mod peeling;
mod sensitivity;
mod setup;
mod table;
