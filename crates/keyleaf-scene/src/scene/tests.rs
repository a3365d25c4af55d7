//! Scene files: what is read, what is written, what is refused and where.

use super::*;
