//! Three-dimensional arithmetic on nodes.

use super::{Graph, Node};

/// Three nodes: the x, y and z components.
pub type Vector = [Node; 3];

/// Six nodes: errors, velocities or loads in the order of ε, or a column of a Jacobian.
pub type Six = [Node; 6];

/// A rigid motion as nodes: rotation matrix by columns, and position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// The x, y and z axes.
    pub axes: [Vector; 3],
    /// The origin.
    pub position: Vector,
}

impl Frame {
    /// Returns the frame of twelve entries: the columns of its matrix, then the position.
    pub(crate) fn from_entries(entries: &[Node]) -> Self {
        let vector = |i: usize| [entries[3 * i], entries[3 * i + 1], entries[3 * i + 2]];
        Self { axes: [0, 1, 2].map(vector), position: vector(3) }
    }

    /// Returns the twelve entries: the columns of the matrix, then the position.
    pub(crate) fn entries(&self) -> [Node; 12] {
        let columns = [self.axes[0], self.axes[1], self.axes[2], self.position];
        std::array::from_fn(|i| columns[i / 3][i % 3])
    }
}

/// Returns the rows of a matrix given by its columns, or the reverse.
pub(crate) fn transposed(columns: &[Vector; 3]) -> [Vector; 3] {
    [0, 1, 2].map(|i: usize| columns.map(|column| column[i]))
}

impl Graph {
    /// Returns the identity.
    pub fn identity(&mut self) -> Frame {
        let (zero, one) = (self.zero(), self.constant(1.0));
        Frame { axes: [[one, zero, zero], [zero, one, zero], [zero, zero, one]], position: [zero; 3] }
    }

    /// Returns `a + b`.
    pub fn add_vectors(&mut self, a: Vector, b: Vector) -> Vector {
        std::array::from_fn(|i| self.add(a[i], b[i]))
    }

    /// Returns `a - b`.
    pub fn sub_vectors(&mut self, a: Vector, b: Vector) -> Vector {
        std::array::from_fn(|i| self.sub(a[i], b[i]))
    }

    /// Returns `k a`.
    pub fn scale(&mut self, k: Node, a: Vector) -> Vector {
        a.map(|component| self.mul(k, component))
    }

    /// Returns `sum + k a`.
    pub(crate) fn add_scaled(&mut self, sum: Vector, k: Node, a: Vector) -> Vector {
        let scaled = self.scale(k, a);
        self.add_vectors(sum, scaled)
    }

    /// Returns `-a`.
    pub fn neg_vector(&mut self, a: Vector) -> Vector {
        a.map(|component| self.neg(component))
    }

    /// Returns `a · b`.
    pub fn dot(&mut self, a: Vector, b: Vector) -> Node {
        let products: [Node; 3] = std::array::from_fn(|i| self.mul(a[i], b[i]));
        let sum = self.add(products[0], products[1]);
        self.add(sum, products[2])
    }

    /// Returns `Σ aᵢ bᵢ`.
    pub(crate) fn products(&mut self, a: &[Node], b: &[Node]) -> Node {
        let products: Vec<Node> = a.iter().zip(b).map(|(a, b)| self.mul(*a, *b)).collect();
        products.into_iter().fold(self.zero(), |sum, product| self.add(sum, product))
    }

    /// Returns `|a|`.
    pub(crate) fn norm(&mut self, a: Vector) -> Node {
        let square = self.dot(a, a);
        self.sqrt(square)
    }

    /// Returns `a × b`.
    pub fn cross(&mut self, a: Vector, b: Vector) -> Vector {
        std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let (left, right) = (self.mul(a[j], b[k]), self.mul(a[k], b[j]));
            self.sub(left, right)
        })
    }

    /// Returns `sum + a × b`.
    pub(crate) fn add_cross(&mut self, sum: Vector, a: Vector, b: Vector) -> Vector {
        let product = self.cross(a, b);
        self.add_vectors(sum, product)
    }

    /// Returns `R v`, where the columns of `R` are `axes`.
    pub fn turn(&mut self, axes: &[Vector; 3], v: Vector) -> Vector {
        let [x, y, z] = [0, 1, 2].map(|i| self.scale(v[i], axes[i]));
        let sum = self.add_vectors(x, y);
        self.add_vectors(sum, z)
    }

    /// Returns the product `a b` of two motions.
    pub fn then(&mut self, a: &Frame, b: &Frame) -> Frame {
        let offset = self.turn(&a.axes, b.position);
        let axes = b.axes.map(|axis| self.turn(&a.axes, axis));
        Frame { axes, position: self.add_vectors(a.position, offset) }
    }

    /// Returns the inverse motion: `Rᵀ`, `−Rᵀ p`.
    pub fn inverse(&mut self, frame: &Frame) -> Frame {
        let back = frame.axes.map(|axis| self.dot(axis, frame.position));
        Frame { axes: transposed(&frame.axes), position: self.neg_vector(back) }
    }

    /// Returns a motion rotated about its own axis 0, 1 or 2; two columns change.
    pub fn turned(&mut self, frame: &Frame, axis: usize, angle: Node) -> Frame {
        let (sine, cosine) = (self.sin(angle), self.cos(angle));
        self.turned_by(frame, axis, sine, cosine)
    }

    /// Returns a motion rotated about its own axis, given the sine and cosine of the angle.
    pub(crate) fn turned_by(&mut self, frame: &Frame, axis: usize, sine: Node, cosine: Node) -> Frame {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let (u, v) = (frame.axes[j], frame.axes[k]);
        let [uc, us, vc, vs] = [(cosine, u), (sine, u), (cosine, v), (sine, v)]
            .map(|(factor, vector)| self.scale(factor, vector));
        let mut turned = *frame;
        turned.axes[j] = self.add_vectors(uc, vs);
        turned.axes[k] = self.sub_vectors(vc, us);
        turned
    }

    /// Returns a motion translated along its own axis 0, 1 or 2.
    pub fn moved(&mut self, frame: &Frame, axis: usize, distance: Node) -> Frame {
        Frame { axes: frame.axes, position: self.add_scaled(frame.position, distance, frame.axes[axis]) }
    }
}
