#ifndef snug_tests_gradient_sensitivity_all_responses_h
#define snug_tests_gradient_sensitivity_all_responses_h

#include <snug/response/response.h>

#include <map>
#include <string>

namespace snug::test {
/// Every quantity of the table, some with several entries, by names.
template <int dim>
std::map<std::string, response::ResponseParameters> all_responses()
{
  std::map<std::string, response::ResponseParameters> result;
  for (const auto &row : response::response_table<dim>())
    {
      if (row.name.rfind("bolt", 0) == 0)
        continue; // the scenes have no bolts
      result[row.name].quantity = row.name;
      // mild, so that differences are exact enough
      result[row.name].exponent  = 5.;
      result[row.name].smoothing = 0.5;
    }
  result["friction force"].component  = response::Component::x;
  result["friction moment"].component = response::Component::z;
  result["friction moment"].point     = std::vector<double>(dim, 0.3);
  const auto axis                     = dim == 2 ? response::Component::y : response::Component::z;
  result["force"]                     = result.at("contact force");
  result["force"].component           = response::Component::x;
  auto &displacement                  = result.at("displacement");
  result["normal on a face"]          = displacement;
  result["axial on a face"]           = displacement;
  displacement.body                   = "foundation";
  displacement.component              = axis;
  displacement.point                  = {0.37, 0.72};
  if (dim == 3)
    displacement.point = {0.37, 0.44, 0.72};
  result["normal on a face"].face     = "foundation.right";
  result["axial on a face"].face      = "foundation.top";
  result["axial on a face"].component = axis;
  for (const auto *of_face : {"rotation", "reaction", "reaction moment"})
    result.at(of_face).face = "foundation.bottom";
  result.at("rotation").face      = "foundation.right";
  result.at("rotation").component = dim == 2 ? response::Component::z : response::Component::y;
  result.at("reaction").component = response::Component::x;
  result.at("reaction moment").component = response::Component::z;
  result.at("reaction moment").point     = {0.2, 0.3};
  if (dim == 3)
    result.at("reaction moment").point = {0.2, 0.3, 0.1};
  result["volume of a body"]       = result.at("volume");
  result["volume of a body"].body  = "foundation";
  result.at("von Mises norm").body = "foundation";
  return result;
}
} // namespace snug::test

#endif
