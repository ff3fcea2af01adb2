#include <snug/shape/bezier_patch.h>
#include <snug/shape/shape_basis.h>

namespace snug
{
  namespace shape
  {
    namespace
    {
      /// The basis of scenes whose shape is fixed.
      template <int dim>
      class NoBasis : public ShapeBasis<dim>
      {
      public:
        using Field = typename ShapeBasis<dim>::Field;

        explicit NoBasis(const mesh::BodyMesh<dim> &mesh) : mesh(mesh)
        {
        }

        unsigned int
        n_variables() const override
        {
          return 0;
        }

        Field
        apply(const std::vector<double> &) const override
        {
          return Field(mesh.n_local_nodes());
        }

        std::vector<double>
        transpose(const Field &) const override
        {
          return {};
        }

        Field
        column(unsigned int) const override
        {
          return Field(mesh.n_local_nodes());
        }

        std::vector<dealii::Point<dim>>
        control_points(const std::vector<double> &) const override
        {
          return {};
        }

      private:
        const mesh::BodyMesh<dim> &mesh;
      };
    } // namespace

    template <int dim>
    const ChoiceTable<
      std::unique_ptr<ShapeBasis<dim>>(const mesh::BodyMesh<dim> &,
                                       const BodyNames &,
                                       const ShapeParameters &)> &
    shape_basis_table()
    {
      using Make = std::unique_ptr<ShapeBasis<dim>>(const mesh::BodyMesh<dim> &,
                                                    const BodyNames &,
                                                    const ShapeParameters &);
      static const ChoiceTable<Make> table = {
        {"none",
         "the shape is fixed",
         [](const auto &mesh, const auto &, const auto &) {
           return std::make_unique<NoBasis<dim>>(mesh);
         }},
        {"Bezier patch",
         "heights [length] of Bézier control points over a face of a body",
         [](const auto &mesh, const auto &bodies, const auto &parameters) {
           return std::make_unique<BezierPatch<dim>>(mesh, bodies, parameters);
         }}};
      return table;
    }

    template const ChoiceTable<
      std::unique_ptr<ShapeBasis<2>>(const mesh::BodyMesh<2> &,
                                     const BodyNames &,
                                     const ShapeParameters &)> &
    shape_basis_table<2>();
    template const ChoiceTable<
      std::unique_ptr<ShapeBasis<3>>(const mesh::BodyMesh<3> &,
                                     const BodyNames &,
                                     const ShapeParameters &)> &
    shape_basis_table<3>();
  } // namespace shape
} // namespace snug
