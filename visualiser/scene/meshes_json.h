// The models and materials as one JSON text, for pages that draw with them.
#pragma once

#include <string>

#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

// {"materials": [{"name", "colour" (number 0xRRGGBB), "gloss", "opacity", "tint" (bool), "painted" (bool), "light"
// (0..15 LED, 16 beacon, -1)}],
//  "models": {name: {"radius", "levels": [{"positions": [x, y, z ...], "normals": [...], "materials": [one a vertex],
//             "shades": [...], "index_steps": [of each corner of a triangle, from the one before; the first from 0],
//             "colours": [0xRRGGBB; not there if no material is painted]}, 3 of them]}},
//  "robots": {"footbot": [{"model": name, "matrix": [16 numbers, column after column]}], ...},
//  "palette": {"sky", "floor", "floor_line", "outside", "wall", "hole", "selection", "label"},
//  "floor_grid": {"spacings": [m …], "most_cells": along the longer side of an arena}}
// Lengths in metres, z up, x forward.
std::string MeshesAsJson();

// Returns the model of a user's kind, or the mesh of an object (object_model.h), as under "models".
std::string ModelAsJson(const Model& model);

}  // namespace swarmanoid
