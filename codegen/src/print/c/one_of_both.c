static double NAME(double x)
{
    double sine_of_x;
    double cosine_of_x;
    sin_cos(x, &sine_of_x, &cosine_of_x);
    return NAME_of_x;
}
