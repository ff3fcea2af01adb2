#include <snug/scene/entries.h>
#include <snug/shape/shape_basis.h>

namespace snug
{
  namespace scene
  {
    namespace
    {
      void
      declare_shape(Entries &entries, shape::ShapeParameters &shape)
      {
        entries.begin_section(shape.section(),
                              "Design variables. Several shapes: see the entry "
                              "'Shapes'.");
        add_choice(entries,
                   "Basis",
                   shape.basis,
                   shape::shape_basis_table<3>(),
                   "How design variables move the nodes.");
        entries.add("Face",
                    shape.face,
                    anything("body.boundary"),
                    "The face that is shaped, 'body.boundary'.");
        entries.add("Control points",
                    shape.control_points,
                    "Number of control points along each edge of the face; "
                    "one design variable each, the first edge fastest.");
        entries.add("Direction",
                    shape.direction,
                    "Direction in which control points move.");
        entries.add("Bounds",
                    shape.bounds,
                    "Smallest and largest move of a control point [length].");
        entries.add("Initial",
                    shape.initial,
                    "Moves of the control points at the start [length]: one "
                    "for each, one for all, or empty: 0.");
      }
    } // namespace

    void
    declare_shapes(Entries &entries, Scene &scene)
    {
      for (auto &shape : scene.shapes)
        declare_shape(entries, shape);
    }
  } // namespace scene
} // namespace snug
