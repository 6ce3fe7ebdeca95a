"""One module per animal; each has make() -> fish.Animal."""
