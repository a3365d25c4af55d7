//! A face with all faces that touch it: what its limit surface depends on.

/// An edge from a corner of the middle face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spoke {
    /// Its far end.
    pub vertex: u32,
    /// How many steps it stays sharp.
    pub sharpness: f64,
    /// The mean sharpness of the other semi-sharp edges at the far end, its own where there are none. For Chaikin creasing.
    pub beyond: f64,
}

/// The faces about a corner of the middle face, counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Fan {
    /// The corner.
    pub vertex: u32,
    /// How many steps it stays sharp.
    pub sharpness: f64,
    /// The place of the middle face in `faces`.
    pub own: usize,
    /// Face k lies between spoke k and spoke k + 1, the last before the first where the fan is closed. An open fan has one spoke more
    /// than faces.
    pub spokes: Vec<Spoke>,
    /// Indices of faces of the ring.
    pub faces: Vec<u32>,
}

impl Fan {
    /// Whether the faces surround the corner.
    pub fn is_closed(&self) -> bool {
        self.spokes.len() == self.faces.len()
    }

    /// The place `offset` faces after the middle face, none beyond an end.
    pub fn face_place(&self, offset: isize) -> Option<usize> {
        self.place(offset, self.faces.len())
    }

    /// The spoke `offset` after the one that leads to the middle face's next corner; 1 leads to its previous corner.
    pub fn spoke(&self, offset: isize) -> Option<Spoke> {
        self.place(offset, self.spokes.len()).map(|place| self.spokes[place])
    }

    /// The place of the spoke after face `place`.
    pub fn after(&self, place: usize) -> usize {
        (place + 1) % self.spokes.len()
    }

    fn place(&self, offset: isize, count: usize) -> Option<usize> {
        let place = self.own as isize + offset;
        if self.is_closed() {
            Some(place.rem_euclid(count as isize) as usize)
        } else {
            usize::try_from(place).ok().filter(|&place| place < count)
        }
    }
}

/// The middle face, number 0, and all faces that touch its corners.
#[derive(Clone, Debug, PartialEq)]
pub struct Ring {
    /// How many vertices there are.
    pub vertex_count: usize,
    /// Vertices of the faces, counter-clockwise. Those of face 0 start with corner 0.
    pub faces: Vec<Vec<u32>>,
    /// By corner of face 0.
    pub fans: Vec<Fan>,
}

impl Ring {
    /// Two rings are alike iff these are equal.
    pub fn signature(&self) -> Vec<u64> {
        let mut words = Vec::with_capacity(16 * self.faces.len());
        words.extend([self.vertex_count as u64, self.fans.len() as u64]);
        for face in &self.faces {
            words.push(face.len() as u64);
            words.extend(face.iter().map(|&vertex| u64::from(vertex)));
        }
        for fan in &self.fans {
            words.extend([fan.own as u64, fan.faces.len() as u64, fan.spokes.len() as u64]);
            words.push(fan.sharpness.to_bits());
            words.extend(fan.faces.iter().map(|&face| u64::from(face)));
            for spoke in &fan.spokes {
                words.extend([
                    u64::from(spoke.vertex),
                    spoke.sharpness.to_bits(),
                    spoke.beyond.to_bits(),
                ]);
            }
        }
        words
    }

    /// Whether all faces have this many corners.
    pub fn has_only(&self, corners: usize) -> bool {
        self.faces.iter().all(|face| face.len() == corners)
    }

    /// The vertex of a face `offset` corners after one of its vertices.
    pub fn vertex_after(&self, face: u32, vertex: u32, offset: usize) -> u32 {
        let corners = &self.faces[face as usize];
        let place = corners.iter().position(|&corner| corner == vertex).unwrap_or(0);
        corners[(place + offset) % corners.len()]
    }

    /// The same ring with the corners numbered from another one: corner 0 becomes corner `turns`.
    pub fn turned(mut self, turns: usize) -> Self {
        self.fans.rotate_right(turns);
        self.faces[0].rotate_right(turns);
        self
    }
}
