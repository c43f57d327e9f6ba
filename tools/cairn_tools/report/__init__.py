"""Everything that is measured of Cairn on one page: `tools/cairn report`."""
