// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lamps with a node tree.
#pragma once

#include <memory>

#include "janus/light/light.h"
#include "janus/shading/program.h"

namespace janus {

// `lamp`, made from `desc` with a strength of 1, times what `program` says of each place and
// direction. It is sampled like the plain lamp; only how often it is chosen depends on the tree.
std::unique_ptr<Light> make_program_light(std::unique_ptr<Light> lamp, const LightDesc& desc,
                                          Program program, const CameraView& camera);

}  // namespace janus
