// Nothing: the target that owns the precompiled headers of the libraries needs a source.
