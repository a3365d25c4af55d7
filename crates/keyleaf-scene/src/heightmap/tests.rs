//! Height maps of all formats, broken ones, and real terrain.

use super::*;
