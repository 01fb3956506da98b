// SPDX-License-Identifier: GPL-3.0-or-later
//
// The choice of passes of data, as settings say it in Python.
#pragma once

#include "bind.h"
#include "janus/film/data_film.h"

namespace janus::python {

using AovList = std::vector<std::pair<std::string, std::string>>;  // name, COLOR or VALUE

// Throws ValueError for a kind that there is not.
MatteKind to_matte_kind(const std::string& name);

// Throws SceneError for a name that there is not.
DataChoice to_data(const std::vector<std::string>& passes, const std::vector<std::string>& mattes,
                   int levels, const AovList& aovs);

// Adds the arguments that make the choice.
void add_data(py::dict& arguments, const DataChoice& choice);

}  // namespace janus::python
