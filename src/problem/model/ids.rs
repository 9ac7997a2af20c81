//! The identifiers of nodes, degrees of freedom, triangles and edges, each a type of its own. All
//! count from 0; files and people count nodes and triangles from 1, by their
//! [`number`](NodeId::number).

use nalgebra::DVector;

/// Declares an identifier that counts from 0.
macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(u32);

        impl $name {
            /// Returns the one at place `index`, from 0.
            pub const fn new(index: usize) -> Self {
                assert!(index <= u32::MAX as usize, "a mesh that fits in memory");
                $name(index as u32)
            }

            /// Returns its place, from 0.
            pub const fn index(self) -> usize {
                self.0 as usize
            }

            /// Returns the first `count` of them, in order.
            pub fn all(
                count: usize,
            ) -> impl DoubleEndedIterator<Item = Self> + Clone + ExactSizeIterator {
                (0..count).map($name::new)
            }
        }
    };
}

/// Adds the number of an identifier for people and files: its place from 1.
macro_rules! numbered {
    ($name:ident) => {
        impl $name {
            /// Returns the one with `number`, from 1.
            pub const fn from_number(number: usize) -> Self {
                $name::new(number - 1)
            }

            /// Returns its number, from 1.
            pub const fn number(self) -> usize {
                self.index() + 1
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                self.number().fmt(f)
            }
        }

        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                self.number().serialize(serializer)
            }
        }
    };
}

id! {
    /// A node of the model: a place in [`Model::nodes`](super::Model::nodes).
    NodeId
}
id! {
    /// A triangle of the model: a place in [`Model::triangles`](super::Model::triangles).
    TriangleId
}
id! {
    /// An edge that the mesh names: a place in [`Model::edges`](super::Model::edges). Its number in
    /// the mesh file is different.
    #[derive(serde::Serialize)]
    EdgeId
}
id! {
    /// A degree of freedom: a displacement of a node n, 2n along x and 2n + 1 along y.
    #[derive(serde::Serialize)]
    Dof
}
numbered!(NodeId);
numbered!(TriangleId);

impl NodeId {
    /// Returns its displacement along x.
    pub const fn x(self) -> Dof {
        Dof::new(2 * self.index())
    }

    /// Returns its displacement along y.
    pub const fn y(self) -> Dof {
        Dof::new(2 * self.index() + 1)
    }

    /// Returns both of its degrees of freedom: x, y.
    pub const fn dofs(self) -> [Dof; 2] {
        [self.x(), self.y()]
    }

    /// Returns its two components of a field over all degrees of freedom.
    pub fn components<T: Copy>(self, field: &DVector<T>) -> [T; 2] {
        self.dofs().map(|dof| field[dof.index()])
    }
}

impl Dof {
    /// Returns its node.
    pub const fn node(self) -> NodeId {
        NodeId(self.0 / 2)
    }

    /// Returns the direction: 0 along x, 1 along y.
    pub const fn direction(self) -> usize {
        self.index() % 2
    }

    /// Returns the unit vector along it.
    pub const fn unit(self) -> [f64; 2] {
        [[1.0, 0.0], [0.0, 1.0]][self.direction()]
    }

    /// Returns `'x'` or `'y'`.
    pub const fn axis(self) -> char {
        ['x', 'y'][self.direction()]
    }
}
