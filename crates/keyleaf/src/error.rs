//! What can go wrong between a scene and its pictures.

/// An error of the library: what, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum KeyleafError {
    /// The capacity cannot hold the roots of the surface.
    #[error(
        "capacity of {capacity} leaves is smaller than the {roots} roots of the surface: raise it to at least {roots}"
    )]
    CapacityBelowRoots {
        /// Leaves asked for.
        capacity: u32,
        /// Roots of the surface.
        roots: u32,
    },
    /// A buffer would be larger than the device allows.
    #[error(
        "{buffer} for {items} {what} needs {bytes} bytes, more than the {limit} bytes that this device binds at once: at most {most} {what} fit"
    )]
    BeyondLimits {
        /// Name of the buffer.
        buffer: &'static str,
        /// What is counted.
        what: &'static str,
        /// How many were asked for.
        items: u64,
        /// Bytes needed.
        bytes: u64,
        /// Bytes allowed.
        limit: u64,
        /// The most that fit.
        most: u64,
    },
    /// A setting is outside its range.
    #[error("setting {setting} is {value}: {expected}")]
    Setting {
        /// Name of the setting.
        setting: &'static str,
        /// Its value.
        value: String,
        /// The range.
        expected: &'static str,
    },
    /// A set of leaves given from outside is not a partition of the roots, or breaks the balance.
    #[error("these leaves are not a balanced quadtree: {0}")]
    Leaves(String),
    /// A moving surface was given what does not fit it.
    #[error("the surface cannot be posed so: {0}")]
    Cage(String),
    /// A texture of a surface is larger than the device allows.
    #[error(
        "a texture of {width}x{height} samples is larger than the {limit} that this device allows a side: scale it down or cut it"
    )]
    TextureTooLarge {
        /// Samples across.
        width: u32,
        /// Samples down.
        height: u32,
        /// The limit a side.
        limit: u32,
    },
    /// No adapter that can compute and draw was found.
    #[error(
        "no graphics adapter found ({0}): install a Vulkan driver (on Debian and Ubuntu without a GPU: libvulkan1 mesa-vulkan-drivers)"
    )]
    NoAdapter(String),
    /// The adapter gave no device.
    #[error("the adapter {adapter} gave no device: {reason}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// What it said.
        reason: String,
    },
    /// A buffer could not be read back.
    #[error("reading {0} back from the device failed: {1}")]
    ReadBack(&'static str, String),
    /// A shader could not be composed.
    #[error(transparent)]
    Compose(#[from] keyleaf_shaders::ComposeError),
}
