//! Pipelines that scenes share.

use keyleaf::draw::{LeafPipeline, Target};
use keyleaf::map::MapPipeline;
use keyleaf::shading::Channel;
use keyleaf::{KeyleafError, Kind, Morph, Passes};
use std::collections::HashMap;
use std::sync::Arc;

/// The pipelines that were compiled so far. Scenes that follow each other on a device can share them.
#[derive(Default)]
pub struct Pipelines {
    passes: HashMap<Kind, Arc<Passes>>,
    draws: HashMap<(Kind, Channel, Target), Arc<LeafPipeline>>,
    maps: HashMap<(Kind, Target), Arc<MapPipeline>>,
}

impl Pipelines {
    /// The passes of the update for a kind of quadtree.
    ///
    /// # Errors
    /// [`KeyleafError`] if the kind is impossible.
    pub fn passes(&mut self, device: &wgpu::Device, kind: Kind) -> Result<Arc<Passes>, KeyleafError> {
        let kind = Kind {
            morph: Morph::None, // as far as the update goes
            ..kind
        };
        if let Some(passes) = self.passes.get(&kind) {
            return Ok(Arc::clone(passes));
        }
        let passes = Arc::new(Passes::new(device, kind)?);
        self.passes.insert(kind, Arc::clone(&passes));
        Ok(passes)
    }

    pub(crate) fn map(
        &mut self,
        device: &wgpu::Device,
        kind: Kind,
        target: Target,
    ) -> Result<Arc<MapPipeline>, KeyleafError> {
        if let Some(pipeline) = self.maps.get(&(kind, target)) {
            return Ok(Arc::clone(pipeline));
        }
        let pipeline = Arc::new(MapPipeline::new(device, &kind, target)?);
        self.maps.insert((kind, target), Arc::clone(&pipeline));
        Ok(pipeline)
    }

    pub(crate) fn draw(
        &mut self,
        device: &wgpu::Device,
        kind: Kind,
        channel: Channel,
        target: Target,
    ) -> Result<Arc<LeafPipeline>, KeyleafError> {
        if let Some(pipeline) = self.draws.get(&(kind, channel, target)) {
            return Ok(Arc::clone(pipeline));
        }
        let pipeline = Arc::new(LeafPipeline::new(device, &kind, channel, target)?);
        self.draws.insert((kind, channel, target), Arc::clone(&pipeline));
        Ok(pipeline)
    }
}
