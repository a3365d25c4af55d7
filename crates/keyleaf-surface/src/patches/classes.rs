//! Numbers that belong together (disjoint sets).

/// Classes of the numbers 0..n. Each is a tree whose root is its least member.
pub struct Classes(Vec<usize>);

impl Classes {
    pub fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    /// Makes the classes of two numbers one.
    pub fn unite(&mut self, a: usize, b: usize) {
        let [a, b] = [self.first(a), self.first(b)];
        self.0[a.max(b)] = a.min(b);
    }

    /// The least member of a number's class; halves the path to it.
    pub fn first(&mut self, mut number: usize) -> usize {
        while self.0[number] != number {
            self.0[number] = self.0[self.0[number]];
            number = self.0[number];
        }
        number
    }
}
