#include <snug/base/section_check.h>
#include <snug/response/response.h>

#include <algorithm>

namespace snug::response {
void ResponseParameters::declare(Entries &entries)
{
  entries.add("Quantity", quantity, choice(names(response_table<3>())),
              "The quantity that the response measures.");
  entries.add("Body", body, allowed("the name of a body"),
              "The body of the response. An empty name means all bodies, or for a displacement the "
              "only body that contains 'Point'.");
  entries.add(
    "Face", face, allowed("body.boundary"),
    "The face over which a displacement is averaged, whose rotation is measured, or whose "
    "supports are.");
  entries.add(
    "Point", point, per_dimension(),
    "The point of a displacement in the reference geometry, which a design moves with "
    "the body; or a point of the axis of a moment, by default the origin. A point outside of the "
    "bodies by up to a tenth of a cell is moved onto the nearest cell. Units: length.");
  entries.add("Reference point", reference_point, allowed("the name of a reference point"),
              "The reference point of a displacement, a rotation, a reaction or a reaction moment, "
              "instead of 'Face'.");
  entries.add("Bolt", bolt, allowed("the name of a bolt"),
              "The bolt whose tension or shortening is measured.");
  entries.add("Component", component,
              "The component of a displacement or a force, or the axis of a rotation or a moment, "
              "which is z in 2D.");
  entries.add("Pair", pair, allowed("slave: master"),
              "The contact pair of the response. An empty name means all pairs.");
  entries.add(
    "Exponent", exponent, between(1., 1000.),
    "The exponent p of p-norms, at least 1. With a larger exponent a norm is closer to the "
    "maximum and less smooth.");
  entries.add(
    "Smoothing", smoothing, above(0., 1.),
    "The part e of the mean contact pressure that separates open area from contact area, above 0 "
    "and at most 1.");
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
  if (reads("Point") && reads("Face") && !reads("Body"))
    section.require(!face.empty(), "Face", face, "must be given for Quantity = " + quantity);
  else if (reads("Point") && reads("Body"))
    {
      section.require(point.empty() != face.empty(), "Point", to_text(point),
                      "either 'Point' or 'Face' must be given");
      section.require(face.empty() || body.empty(), "Body", body, "must be left out with 'Face'");
      section.require(point.empty() || (component >= Component::x && component <= Component::z),
                      "Component", to_text(component), "must be x, y or z with 'Point'");
    }
  const bool turns =
    quantity == "rotation" || quantity == "reaction moment" || quantity == "friction moment";
  section.require((component != Component::z && component != Component::axial) ||
                    section.dimension == 3 || turns,
                  "Component", to_text(component),
                  "must be normal, x, y, radial or tangential for Dimension = 2");
}
} // namespace snug::response
