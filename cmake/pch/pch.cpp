// Compiled once; every library reuses its precompiled headers.
