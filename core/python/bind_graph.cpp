// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind.h"
#include "janus/util/error.h"

namespace janus::python {

namespace {

// Reads one graph; knows where it is, for messages.
class GraphReader {
 public:
  explicit GraphReader(const std::string& key) : key_(key) {}

  NodeGraph read(const py::dict& graph) {
    NodeGraph result;
    path_ = "graph";
    if (!graph.contains("nodes") || !py::isinstance<py::sequence>(graph["nodes"])) {
      fail("'nodes' must be a list");
    }
    for (const py::handle item : graph["nodes"]) {
      path_ = "nodes[" + std::to_string(result.nodes.size()) + "]";
      if (!py::isinstance<py::dict>(item)) {
        fail("must be a dict");
      }
      result.nodes.push_back(node(py::reinterpret_borrow<py::dict>(item)));
    }
    result.surface = end(graph, "surface");
    result.displacement = end(graph, "displacement");
    return result;
  }

 private:
  // What is linked to an input of the output node.
  std::optional<NodeLink> end(const py::dict& graph, const char* name) {
    path_ = name;
    if (!graph.contains(name) || graph[name].is_none()) {
      return std::nullopt;
    }
    const py::object given = graph[name];
    if (!py::isinstance<py::dict>(given)) {
      fail("must be None or {'link': [node, output]}");
    }
    return link(given);
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw SceneError(key_, path_, message);
  }

  std::string text(const py::dict& item, const char* field) const {
    if (!item.contains(field) || !py::isinstance<py::str>(item[field])) {
      fail(std::string("'") + field + "' must be a string");
    }
    return item[field].cast<std::string>();
  }

  Node node(const py::dict& item) {
    Node result;
    result.name = text(item, "name");
    result.type = text(item, "type");
    const std::string base = "nodes[" + result.name + "]";
    path_ = base;
    for (const auto& [identifier, value] : dict(item, "inputs")) {
      path_ = base + ".inputs[" + py::str(identifier).cast<std::string>() + "]";
      result.inputs[py::str(identifier)] = input(value);
    }
    path_ = base;
    for (const auto& [identifier, value] : dict(item, "properties")) {
      // None and lists of other things are Blender's too, but no node type of ours reads them.
      const std::string name = py::str(identifier);
      if (py::isinstance<py::bool_>(value)) {
        result.properties[name] = value.cast<bool>();
      } else if (py::isinstance<py::str>(value)) {
        result.properties[name] = value.cast<std::string>();
      } else if (is_number(value)) {
        result.properties[name] = number(value);
      } else if (auto list = numbers(value)) {
        result.properties[name] = std::move(*list);
      }
    }
    return result;
  }

  py::dict dict(const py::dict& item, const char* field) const {
    if (!item.contains(field)) {
      return {};
    }
    if (!py::isinstance<py::dict>(item[field])) {
      fail(std::string("'") + field + "' must be a dict");
    }
    return py::reinterpret_borrow<py::dict>(item[field]);
  }

  NodeLink link(const py::handle& item) const {
    const auto d = py::reinterpret_borrow<py::dict>(item);
    if (d.contains("link") && py::isinstance<py::sequence>(d["link"])) {
      const auto pair = py::reinterpret_borrow<py::sequence>(d["link"]);
      if (pair.size() == 2 && py::isinstance<py::str>(pair[0]) &&
          py::isinstance<py::str>(pair[1])) {
        return {pair[0].cast<std::string>(), pair[1].cast<std::string>()};
      }
    }
    fail("a link must be {'link': [node, output]}");
  }

  NodeInput input(const py::handle& value) const {
    if (value.is_none()) {
      return std::monostate();
    }
    if (py::isinstance<py::dict>(value)) {
      return link(value);
    }
    if (py::isinstance<py::str>(value)) {
      return value.cast<std::string>();
    }
    if (is_number(value)) {
      return number(value);
    }
    if (py::isinstance<py::sequence>(value) || py::isinstance<py::array>(value)) {
      std::vector<float> v;
      for (const py::handle component : py::reinterpret_borrow<py::iterable>(value)) {
        if (!is_number(component)) {
          fail("a vector must hold numbers");
        }
        v.push_back(number(component));
      }
      if (v.size() == 3) {
        return vec3(v[0], v[1], v[2]);
      }
      if (v.size() == 4) {
        return vec4(v[0], v[1], v[2], v[3]);
      }
      fail("a vector must have 3 or 4 components, not " + std::to_string(v.size()));
    }
    fail("must be None, a number, a string, 3 or 4 numbers, or a link");
  }

  // A sequence of numbers, such as the samples of a curve.
  std::optional<std::vector<float>> numbers(const py::handle& value) const {
    if (!py::isinstance<py::sequence>(value) && !py::isinstance<py::array>(value)) {
      return std::nullopt;
    }
    std::vector<float> list;
    for (const py::handle item : py::reinterpret_borrow<py::iterable>(value)) {
      if (!is_number(item)) {
        return std::nullopt;
      }
      list.push_back(number(item));
    }
    return list;
  }

  // Python's numbers and NumPy's scalars.
  static bool is_number(const py::handle& value) {
    return PyNumber_Check(value.ptr()) && !PySequence_Check(value.ptr()) &&
           !PyComplex_Check(value.ptr());
  }

  float number(const py::handle& value) const {
    const double result = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred()) {
      PyErr_Clear();
      fail("a number is out of range");
    }
    return static_cast<float>(result);
  }

  std::string key_, path_;
};

}  // namespace

NodeGraph to_graph(const std::string& key, const py::dict& graph) {
  return GraphReader(key).read(graph);
}

}  // namespace janus::python
