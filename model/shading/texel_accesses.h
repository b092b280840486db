// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "shading/shader.h"

namespace sheaf {

/// Appends the texels that shading a hit reads, as Shader::surface lists them.
void add_texel_accesses(const Scene& scene, const Hit& hit, std::vector<TexelAccess>& texels);

}  // namespace sheaf
