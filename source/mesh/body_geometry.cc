#include <snug/mesh/axis_spacing.h>
#include <snug/mesh/body_geometry.h>
#include <snug/mesh/curved_face.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace snug
{
  namespace mesh
  {
    namespace
    {
      /// "a, b, c" as the user writes lists.
      template <typename Number>
      std::string
      joined(const std::vector<Number> &values)
      {
        std::ostringstream text;
        for (std::size_t i = 0; i < values.size(); ++i)
          text << (i == 0 ? "" : ", ") << values[i];
        return text.str();
      }

      /// One number per axis of the entry, @p otherwise where it is empty.
      template <int dim, typename Number>
      std::array<Number, dim>
      per_axis(const std::string         &entry,
               const std::vector<Number> &values,
               Number                     otherwise,
               bool                       positive)
      {
        std::array<Number, dim> result;
        result.fill(otherwise);
        if (values.empty())
          return result;
        bool good = values.size() == dim;
        for (const Number value : values)
          good = good && std::isfinite(static_cast<double>(value)) &&
                 (!positive || value > Number());
        if (!good)
          throw bad_entry(entry,
                          joined(values),
                          std::string("must be ") + std::to_string(dim) +
                            (positive ? " numbers > 0" : " numbers"));
        std::copy(values.begin(), values.end(), result.begin());
        return result;
      }

      /**
       * A box with graded cells and curved faces. Logical coordinate xi of an
       * axis is the fraction f(xi) of its length (AxisSpacing). Each curved
       * face moves along its outward normal; the movement fades linearly with
       * f to zero at the opposite face.
       */
      template <int dim>
      class BoxGeometry : public BodyGeometry<dim>
      {
      public:
        explicit BoxGeometry(const BodyMeshParameters &parameters);

        typename BodyGeometry<dim>::CoarseMesh
        coarse_mesh() const override;

        const std::vector<std::string> &
        boundary_names() const override
        {
          return names;
        }

        dealii::Point<dim>
        position(const dealii::Point<dim> &logical) const override;

        dealii::Point<dim>
        box_fraction(const dealii::Point<dim> &logical) const override;

        dealii::Point<dim>
        box_position(const dealii::Point<dim> &fraction) const override;

      private:
        std::vector<std::string>      names;
        std::array<double, dim>       corner, size;
        std::array<unsigned int, dim> cells;
        std::array<AxisSpacing, dim>  spacing;
        std::vector<CurvedFace<dim>>  curved_faces;

        void
        set_spacing(const BodyMeshParameters &parameters);
        void
        add_curved_face(const std::string &face, const std::string &value);
        unsigned int
        vertex(std::array<unsigned int, dim> position) const;
      };

      template <int dim>
      BoxGeometry<dim>::BoxGeometry(const BodyMeshParameters &parameters)
        : names(dim == 2
                  ? std::vector<std::string>{"left", "right", "bottom", "top"}
                  : std::vector<std::string>{"left",
                                             "right",
                                             "front",
                                             "back",
                                             "bottom",
                                             "top"})
        , corner(
            per_axis<dim, double>("Box corner", parameters.corner, 0., false))
        , size(per_axis<dim, double>("Box size", parameters.size, 1., true))
        , cells(
            per_axis<dim, unsigned int>("Box cells", parameters.cells, 1, true))
      {
        set_spacing(parameters);
        for (const auto &face : parameters.curved_faces)
          add_curved_face(face.first, face.second);
        // Formulas without a finite value are found here, on all ranks alike,
        // unless that happens between the vertices of the coarse mesh.
        if (!curved_faces.empty())
          for (const auto &point : coarse_mesh().vertices)
            position(point);
      }

      template <int dim>
      void
      BoxGeometry<dim>::set_spacing(const BodyMeshParameters &parameters)
      {
        const auto grading =
          per_axis<dim, double>("Box grading", parameters.grading, 1., true);
        const auto fine = per_axis<dim, double>("Box fine length",
                                                parameters.fine_length,
                                                0.,
                                                false);
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (cells[d] == 1 && grading[d] != 1.)
              throw bad_entry("Box grading",
                              joined(parameters.grading),
                              "must be 1 along an axis with a single cell");
            if (fine[d] != 0. && !(fine[d] > 0. && fine[d] < size[d] &&
                                   cells[d] > 1 && grading[d] == 1.))
              throw bad_entry("Box fine length",
                              joined(parameters.fine_length),
                              "must be 0, or below the size of the box along "
                              "an axis with several cells and no grading");
            spacing[d] =
              fine[d] != 0.
                ? AxisSpacing::with_fine_part(cells[d], fine[d] / size[d])
                : AxisSpacing::graded(cells[d], grading[d]);
          }
      }

      template <int dim>
      void
      BoxGeometry<dim>::add_curved_face(const std::string &face,
                                        const std::string &value)
      {
        const auto found = std::find(names.begin(), names.end(), face);
        if (found == names.end())
          throw bad_entry("Curved faces",
                          face + ": " + value,
                          "the faces are " + joined(names));
        FlatFace<dim> flat;
        flat.boundary = found - names.begin();
        flat.name     = face;
        for (unsigned int d = 0; d < dim; ++d)
          {
            flat.half_size[d] = 0.5 * size[d];
            flat.centre[d]    = corner[d] + 0.5 * size[d];
          }
        const unsigned int normal = flat.boundary / 2;
        flat.centre[normal] =
          corner[normal] + (flat.boundary % 2 == 1 ? size[normal] : 0.);
        curved_faces.emplace_back(flat, value);
      }

      template <int dim>
      unsigned int
      BoxGeometry<dim>::vertex(std::array<unsigned int, dim> position) const
      {
        unsigned int index = 0;
        for (int d = dim - 1; d >= 0; --d)
          index = index * (cells[d] + 1) + position[d];
        return index;
      }

      /// All multi-indices below @p n, the first index fastest.
      template <int dim>
      std::vector<std::array<unsigned int, dim>>
      multi_indices(const std::array<unsigned int, dim> &n)
      {
        std::vector<std::array<unsigned int, dim>> result(1);
        result[0].fill(0);
        for (int d = dim - 1; d >= 0; --d)
          {
            const auto slower = result;
            result.clear();
            for (auto index : slower)
              for (index[d] = 0; index[d] < n[d]; ++index[d])
                result.push_back(index);
          }
        return result;
      }

      template <int dim>
      typename BodyGeometry<dim>::CoarseMesh
      BoxGeometry<dim>::coarse_mesh() const
      {
        using Index = std::array<unsigned int, dim>;
        using Info  = dealii::GeometryInfo<dim>;
        typename BodyGeometry<dim>::CoarseMesh mesh;
        Index                                  n_vertices = cells;
        for (unsigned int &n : n_vertices)
          ++n;
        for (const Index &index : multi_indices<dim>(n_vertices))
          {
            dealii::Point<dim> point;
            for (unsigned int d = 0; d < dim; ++d)
              point[d] = static_cast<double>(index[d]) / cells[d];
            mesh.vertices.push_back(point);
          }
        for (const Index &index : multi_indices<dim>(cells))
          {
            std::vector<unsigned int> cell(Info::vertices_per_cell);
            for (unsigned int v = 0; v < cell.size(); ++v)
              {
                Index position = index;
                for (unsigned int d = 0; d < dim; ++d)
                  position[d] += v >> d & 1;
                cell[v] = vertex(position);
              }
            mesh.cells.push_back(cell);
            for (unsigned int f = 0; f < Info::faces_per_cell; ++f)
              if (index[f / 2] == (f % 2 == 1 ? cells[f / 2] - 1 : 0))
                {
                  std::vector<unsigned int> face(Info::vertices_per_face);
                  for (unsigned int v = 0; v < face.size(); ++v)
                    face[v] = cell[Info::face_to_cell_vertices(f, v)];
                  mesh.boundary_faces.emplace_back(face, f);
                }
          }
        return mesh;
      }

      template <int dim>
      dealii::Point<dim>
      BoxGeometry<dim>::box_fraction(const dealii::Point<dim> &logical) const
      {
        dealii::Point<dim> fraction;
        for (unsigned int d = 0; d < dim; ++d)
          fraction[d] = spacing[d].fraction(logical[d]);
        return fraction;
      }

      template <int dim>
      dealii::Point<dim>
      BoxGeometry<dim>::box_position(const dealii::Point<dim> &fraction) const
      {
        dealii::Point<dim> position;
        for (unsigned int d = 0; d < dim; ++d)
          position[d] = corner[d] + size[d] * fraction[d];
        return position;
      }

      template <int dim>
      dealii::Point<dim>
      BoxGeometry<dim>::position(const dealii::Point<dim> &logical) const
      {
        const dealii::Point<dim> fraction = box_fraction(logical);
        const dealii::Point<dim> flat     = box_position(fraction);
        dealii::Point<dim>       result   = flat;
        for (const auto &face : curved_faces)
          {
            const unsigned int axis  = face.boundary() / 2;
            const bool         upper = face.boundary() % 2 == 1;
            const double blend = upper ? fraction[axis] : 1. - fraction[axis];
            result[axis] +=
              (upper ? 1. : -1.) * blend * face.displacement(flat);
          }
        return result;
      }
    } // namespace

    template <int dim>
    const ChoiceTable<
      std::unique_ptr<BodyGeometry<dim>>(const BodyMeshParameters &)> &
    body_geometry_table()
    {
      using Make =
        std::unique_ptr<BodyGeometry<dim>>(const BodyMeshParameters &);
      static const ChoiceTable<Make> table = {
        {"box",
         "box of hexahedra or quadrilaterals, with graded cells and curved "
         "faces [length]",
         [](const BodyMeshParameters &parameters) {
           return std::make_unique<BoxGeometry<dim>>(parameters);
         }}};
      return table;
    }

    template <int dim>
    unsigned int
    boundary_index(const BodyGeometry<dim> &geometry, const std::string &name)
    {
      const auto &names = geometry.boundary_names();
      const auto  found = std::find(names.begin(), names.end(), name);
      if (found == names.end())
        throw InputError("'" + name + "' is no face; the faces are " +
                         joined(names));
      return found - names.begin();
    }

    template const ChoiceTable<
      std::unique_ptr<BodyGeometry<2>>(const BodyMeshParameters &)> &
    body_geometry_table<2>();
    template const ChoiceTable<
      std::unique_ptr<BodyGeometry<3>>(const BodyMeshParameters &)> &
    body_geometry_table<3>();
    template unsigned int
    boundary_index(const BodyGeometry<2> &, const std::string &);
    template unsigned int
    boundary_index(const BodyGeometry<3> &, const std::string &);
  } // namespace mesh
} // namespace snug
