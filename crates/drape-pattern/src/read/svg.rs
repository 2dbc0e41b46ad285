//! x
use drape_input::{Document,Diagnostics};
use crate::pattern::Pattern; use super::request::Request;
pub(crate) fn read(_d: &Document, _r: &Request) -> Result<Pattern, Diagnostics> { Err(Diagnostics(vec![])) }
