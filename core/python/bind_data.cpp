// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind_data.h"

#include "janus/util/error.h"

namespace janus::python {

namespace {

constexpr EnumName<MatteKind> kMatteKindNames[] = {
    {"Object", MatteKind::Object}, {"Material", MatteKind::Material}, {"Asset", MatteKind::Asset}};
constexpr EnumName<bool> kAovTypes[] = {{"COLOR", true}, {"VALUE", false}};

}  // namespace

MatteKind to_matte_kind(const std::string& name) {
  return from_name(kMatteKindNames, name, "cryptomatte");
}

DataChoice to_data(const std::vector<std::string>& passes, const std::vector<std::string>& mattes,
                   int levels, const AovList& aovs) {
  DataChoice choice;
  choice.matte_levels = levels;
  for (const std::string& name : passes) {
    const auto* found = std::ranges::find(kDataPasses, name, &DataPassInfo::name);
    if (found == std::end(kDataPasses)) {
      throw SceneError("settings", "data_passes", "there is no pass '" + name + "'");
    }
    choice.passes[found - kDataPasses] = true;
  }
  for (const std::string& name : mattes) {
    choice.mattes[static_cast<size_t>(to_matte_kind(name))] = true;
  }
  for (const auto& [name, type] : aovs) {
    choice.aovs.push_back({name, from_name(kAovTypes, type, "aovs")});
  }
  return choice;
}

void add_data(py::dict& arguments, const DataChoice& choice) {
  py::list passes, mattes;
  AovList aovs;
  for (size_t i = 0; i < kDataPassCount; ++i) {
    if (choice.passes[i]) {
      passes.append(kDataPasses[i].name);
    }
  }
  for (const auto& [name, kind] : kMatteKindNames) {
    if (choice.wants(kind)) {
      mattes.append(name);
    }
  }
  for (const AovPass& aov : choice.aovs) {
    aovs.emplace_back(aov.name, to_name(kAovTypes, aov.color));
  }
  arguments["data_passes"] = passes;
  arguments["cryptomatte"] = mattes;
  arguments["cryptomatte_levels"] = choice.matte_levels;
  arguments["aovs"] = aovs;
}

}  // namespace janus::python
