"""The console: a page in the browser that shows missions and steers them. ROS-free."""
