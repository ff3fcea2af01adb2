"""Derivatives of a design against fourth-order differences."""


def assert_gradients(test, model, x, step, tolerance=1e-8, of_values=False):
    """Compare the gradients of all responses at the design x with differences of the given step. The
    tolerance refers to the gradient, or with of_values to the larger one of gradient and value, for
    responses that hardly change."""
    result = model.evaluate(x, gradients=True)
    test.assertGreater(len(result.gradients), 0)
    for j in range(len(x)):
        a, b, c, d = (model.evaluate([value + k * step * (i == j) for i, value in enumerate(x)])
                      for k in (-2, -1, 1, 2))
        for name, gradient in result.gradients.items():
            difference = (a[name] - 8. * b[name] + 8. * c[name] - d[name]) / (12. * step)
            size = abs(gradient).max()
            test.assertAlmostEqual(gradient[j], difference, msg=name, delta=tolerance * (
                max(size, abs(result[name])) if of_values else size))
