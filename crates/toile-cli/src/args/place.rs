//! Where it runs.

use clap::{Args, ValueEnum};

/// Where it runs.
#[derive(Args, Debug)]
pub struct Place {
    /// Part of the name of the adapter to use.
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// What computes.
    #[arg(long, value_enum, default_value_t = Backend::Gpu)]
    pub backend: Backend,
}

/// What computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Backend {
    /// A GPU, or a Vulkan driver that works on the CPU.
    Gpu,
    /// The CPU reference, for machines without any adapter.
    Reference,
}
