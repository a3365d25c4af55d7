//! `Pressure` of the executable model, literally: it lowers the threshold only when the next step fits twice over. For replaying its
//! recorded runs.

use keyleaf_key::Forest;

#[derive(Default)]
pub struct ModelPressure {
    pub steps: u32,
    idle: u32,
}

impl ModelPressure {
    pub fn scale(&self) -> f64 {
        (-f64::from(self.steps) / 4.0).exp2()
    }

    pub fn observe(&mut self, forest: &Forest<'_>, changed: usize, capacity: usize) {
        self.idle = if changed > 0 { 0 } else { self.idle + 1 };
        if self.idle < 3 {
            return;
        }
        let wishes = || forest.leaves.values().map(|published| f64::from(published.wish));
        let near = wishes().filter(|w| *w > (-0.25_f64).exp2() && *w <= 1.0).count();
        if wishes().any(|w| w > 1.0) {
            self.steps += 1;
            self.idle = 0;
        } else if self.steps > 0 && 6 * near <= capacity - forest.leaves.len() {
            self.steps -= 1;
            self.idle = 0;
        }
    }
}
