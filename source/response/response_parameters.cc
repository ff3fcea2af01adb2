#include <snug/base/section_check.h>
#include <snug/response/response.h>

#include <algorithm>

namespace snug::response {
void ResponseParameters::declare(Entries &entries)
{
  entries.add("Quantity", quantity, choice(names(response_table<3>())), "What it measures.");
  entries.add("Body", body, allowed("the name of a body"),
              "The body that counts; empty: all, or the only one that holds the point.");
  entries.add("Face", face, allowed("body.boundary"),
              "The face a displacement is averaged over, 'body.boundary'.");
  entries.add("Point", point, per_dimension(),
              "The point whose displacement counts [length], in the reference geometry; designs "
              "carry it along.");
  entries.add("Component", component,
              "Of a displacement or a contact force. normal: along the outward normal of the face; "
              "contact forces: all sizes added up.");
  entries.add("Pair", pair, allowed("slave: master"),
              "The contact pair that counts, 'slave: master'; empty: all.");
  entries.add("Exponent", exponent, between(1., 1000.),
              "The p of p-norms, at least 1; the larger, the nearer to the largest value, and the "
              "less smooth.");
  entries.add(
    "Smoothing", smoothing, above(0., 1.),
    "Part of the mean contact pressure below which area does not count; above 0, at most 1.");
}

bool ResponseParameters::reads(const std::string &entry) const
{
  // The responses of 2D and 3D read the same entries.
  const auto entries = make_response<3>(*this)->entries();
  return std::find(entries.begin(), entries.end(), entry) != entries.end();
}

void ResponseParameters::check(const SectionCheck &section) const
{
  auto read = make_response<3>(*this)->entries();
  read.push_back("Quantity");
  section.require_read(*this, read, "must be left out for Quantity = " + quantity);
  if (reads("Point"))
    {
      section.require(point.empty() != face.empty(), "Point", to_text(point),
                      "either 'Point' or 'Face' must be given");
      section.require(face.empty() || body.empty(), "Body", body, "must be left out with 'Face'");
      section.require(point.empty() || component != Component::normal, "Component",
                      to_text(component), "must be x, y or z with 'Point'");
    }
  section.require(component != Component::z || section.dimension == 3, "Component",
                  to_text(component), "must be normal, x or y for Dimension = 2");
}
} // namespace snug::response
