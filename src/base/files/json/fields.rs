//! Which kind of document a text is, by a field of it.

use std::fmt;

use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};

/// Returns whether the outermost object of `text` has a field `name`, as far as it can be read.
pub fn has_field(text: &[u8], name: &str) -> bool {
    let Ok(text) = super::utf8(text) else { return false };
    let mut is_found = false;
    let search = Search { name, is_found: &mut is_found };
    // What is malformed behind the field does not matter here.
    let _ = serde_json::Deserializer::from_str(text).deserialize_map(search);
    is_found
}

struct Search<'a> {
    name: &'a str,
    is_found: &'a mut bool,
}

impl<'de> Visitor<'de> for Search<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(name) = map.next_key::<String>()? {
            *self.is_found |= name == self.name;
            if *self.is_found {
                return Ok(());
            }
            map.next_value::<IgnoredAny>()?;
        }
        Ok(())
    }
}
