//! What is counted in a model, each by a type of its own: nodes, degrees of freedom, triangles,
//! edges. All count from 0; files and people count nodes and triangles from 1: that is their
//! [`number`](NodeId::number).

use nalgebra::DVector;

/// Declares a newtype that counts from 0 inside and from 1 for people.
macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(usize);

        impl $name {
            /// The one at place `index`, from 0.
            pub const fn new(index: usize) -> Self {
                $name(index)
            }

            /// Its place, from 0.
            pub const fn index(self) -> usize {
                self.0
            }

            /// The first `count` of them, in order.
            pub fn all(count: usize) -> impl DoubleEndedIterator<Item = Self> + Clone + ExactSizeIterator {
                (0..count).map($name)
            }
        }
    };
}

/// Adds the number that people and files use: the place from 1.
macro_rules! numbered {
    ($name:ident) => {
        impl $name {
            /// The one with `number`, from 1.
            pub const fn from_number(number: usize) -> Self {
                $name(number - 1)
            }

            /// Its number, from 1.
            pub const fn number(self) -> usize {
                self.0 + 1
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

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                match usize::deserialize(deserializer)? {
                    0 => Err(serde::de::Error::custom("numbers count from 1")),
                    number => Ok($name::from_number(number)),
                }
            }
        }
    };
}

id! {
    /// A node.
    NodeId
}
id! {
    /// A triangle.
    TriangleId
}
id! {
    /// An edge that the mesh names: a place in [`Model::edges`](super::Model::edges). Its number in
    /// the mesh file is another.
    EdgeId
}
id! {
    /// A degree of freedom: the displacement of a node along x or y. Those of node n are 2n and 2n
    /// + 1.
    Dof
}
numbered!(NodeId);
numbered!(TriangleId);

impl NodeId {
    /// Its displacement along x.
    pub const fn x(self) -> Dof {
        Dof(2 * self.0)
    }

    /// Its displacement along y.
    pub const fn y(self) -> Dof {
        Dof(2 * self.0 + 1)
    }

    /// Both of its degrees of freedom: x, y.
    pub const fn dofs(self) -> [Dof; 2] {
        [self.x(), self.y()]
    }

    /// Its two components of a field over all degrees of freedom.
    pub fn of<T: Copy>(self, field: &DVector<T>) -> [T; 2] {
        self.dofs().map(|dof| field[dof.0])
    }
}

impl Dof {
    /// The node that moves.
    pub const fn node(self) -> NodeId {
        NodeId(self.0 / 2)
    }

    /// The direction: 0 along x, 1 along y.
    pub const fn direction(self) -> usize {
        self.0 % 2
    }

    /// The letter of its direction.
    pub const fn axis(self) -> char {
        ['x', 'y'][self.direction()]
    }
}
