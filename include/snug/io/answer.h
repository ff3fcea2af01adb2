#ifndef snug_io_answer_h
#define snug_io_answer_h

#include <snug/base/warning.h>
#include <snug/scene/scene.h>
#include <snug/shape/shapes.h>
#include <snug/state/state_solver.h>

#include <nlohmann/json.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace snug::io {
/// A JSON value that keeps the order of its members. Numbers that are not finite become null.
using Json = nlohmann::ordered_json;

/// Error for a request to a server that is wrong in form or in a name, a number or a bound. Nothing
/// was computed for it.
class RequestError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Write an answer in one line to a descriptor. Return false if nobody reads it. Bytes that are no
/// UTF-8 are replaced.
bool write_line(int descriptor, const Json &answer);

/// Return {kind, message} of an error. Errors of the input also have those of the members file,
/// line, entry, value, allowed and suggestion that are known.
Json error_part(const std::exception &error);

/// Return a list of {code, text, value, bound}.
Json warnings_part(const std::vector<Warning> &warnings);

/// Return {name, max_pressure, ...} of each load case, as in summary.json.
template <int dim>
Json load_cases_part(const scene::Scene                          &scene,
                     const std::vector<state::ContactState<dim>> &states);

/// Return the contact rows of each load case and pair, as lists of the same length. Positions are
/// those of the slave nodes without displacements, in the position of the load case, and normals
/// are unit vectors into the master. Collective.
template <int dim>
Json contact_part(const scene::Scene                          &scene,
                  const state::StateSolver<dim>               &solver,
                  const std::vector<state::ContactState<dim>> &states);

/// Return {name, lower, upper, start, scale, unit} of each design variable. The scale is the change
/// in the first step of a search. Collective.
template <int dim>
Json variables_part(const scene::Scene &scene, const shape::Shapes<dim> &shapes);
} // namespace snug::io

#endif
